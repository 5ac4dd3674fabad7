#include "emulator/run/outbox.h"

#include <malloc.h>

#include <algorithm>
#include <utility>

#include "emulator/transport/uart.h"

namespace echoloop {
namespace {

constexpr std::size_t outbox_limit = 48 << 20;  // bytes of memory
constexpr double line_patience = 2;             // s; what a serial line cannot say within is not said at all

}  // namespace

std::size_t Mail::memory() const {
    constexpr std::size_t of_a_row = 96;  // of the map, and what the allocator adds
    return sizeof(Mail) + of_a_row + send.bytes.capacity() + remark.capacity();
}

const Mail* Outbox::post(Mail mail, double line_rate) {
    if (memory_ + mail.memory() > outbox_limit) return nullptr;
    const auto waiting = static_cast<double>(bytes_for_[mail.send.port]);
    if (line_rate > 0 && waiting > line_patience * line_rate / uart::bits_per_byte) return nullptr;
    count(mail, true);
    const Time when = mail.send.not_before;
    const auto place = mail_.emplace(when, std::move(mail));
    most_memory_ = std::max(most_memory_, memory_);
    most_messages_ = std::max(most_messages_, mail_.size());
    most_bytes_ = std::max(most_bytes_, bytes_);
    return &place->second;
}

Mail Outbox::take_first() {
    count(mail_.begin()->second, false);
    return std::move(mail_.extract(mail_.begin()).mapped());
}

void Outbox::clear() {
    mail_.clear();
    bytes_ = memory_ = 0;
    std::ranges::fill(bytes_for_, 0U);
}

void Outbox::forget(std::size_t port) {
    std::erase_if(mail_, [&](const auto& entry) {
        if (entry.second.send.port != port) return false;
        count(entry.second, false);
        return true;
    });
}

void Outbox::count(const Mail& mail, bool comes) {
    const auto add = [comes](std::size_t& sum, std::size_t size) { comes ? sum += size : sum -= size; };
    add(bytes_, mail.send.bytes.size());
    add(memory_, mail.memory());
    add(bytes_for_[mail.send.port], mail.send.bytes.size());
}

void Outbox::release_memory() {
    constexpr std::size_t worth_it = 4 << 20;  // bytes
    if (std::exchange(most_memory_, 0) > worth_it) ::malloc_trim(0);
}

}  // namespace echoloop
