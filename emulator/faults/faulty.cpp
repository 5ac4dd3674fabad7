#include "emulator/faults/faulty.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "emulator/transport/address.h"

namespace echoloop {
namespace {

/// What is missing has no byte of its own on the wire.
bool is_missing(const FaultEvent& event) {
    return event.kind == FaultKind::loss || event.kind == FaultKind::silence ||
           event.kind == FaultKind::truncation || event.kind == FaultKind::baud_mismatch;
}

}  // namespace

Faulty::Faulty(Clock& clock, std::unique_ptr<Transport> transport, DeviceFaults& faults,
               const std::string& name, const MessageTraits& traits)
    : Decorator(std::move(transport)),
      clock_(clock),
      faults_(faults),
      out_(faults, {faults.name(), name, Towards::to_driver}, traits),
      in_(faults, {faults.name(), name, Towards::from_driver}, traits),
      out_bell_(clock),
      in_bell_(clock),
      several_(traits.several) {}

void Faulty::start(Events events) {
    events_ = std::move(events);
    Events own = events_;
    own.received = [this](ByteView bytes, Address from) {
        if (!faults_.any() && in_.idle()) {
            in_.passed(bytes.size());
            heard_ += bytes.size();
            return events_.received(bytes, from);
        }
        in_.add(bytes, from, clock_.now());
        for (const FaultEvent& event : in_.made_of_last()) line().annotate_received(comment_of(event));
        hear_what_is_due();
        in_bell_.cancel();
    };
    own.reconnected = [this] {
        out_.clear();
        in_.clear();
        events_.reconnected();
    };
    own.connected = [this](Address driver) {
        driver_ = driver;
        events_.connected(driver);
    };
    line().start(std::move(own));
    asio::co_spawn(clock_.io(), keep_sending(), Serving(describe()));
    asio::co_spawn(clock_.io(), keep_hearing(), Serving(describe()));
}

Task<void> Faulty::write(ByteView bytes, Address to) {
    if (!faults_.any() && out_.idle() && !sending_) {
        out_.passed(bytes.size());
        line().speak_at(line_rate_);
        co_await line().write(bytes, to);
        co_return;
    }
    const bool had_room = out_.dropped_bytes() == 0;
    out_.add(bytes, to, clock_.now(), line_rate_);
    if (had_room && out_.dropped_bytes() > 0)
        spdlog::warn("{}: too many messages are delayed by faults; messages are dropped", describe());
    out_bell_.cancel();
}

std::uint64_t Faulty::bytes_lost() const { return line().bytes_lost() + out_.dropped_bytes(); }

void Faulty::hang_up(Address to) {
    if (out_.idle() && !sending_) return line().hang_up(to);
    out_.hang_up(clock_.now());
    out_bell_.cancel();
}

Task<void> Faulty::keep_sending() {
    while (!closed_) {
        auto piece = out_.take(clock_.now());
        if (!piece) {
            co_await out_bell_.until(out_.next_due().value_or(Time::max()));
            continue;
        }
        sending_ = true;
        co_await send(std::move(*piece));
        sending_ = false;
    }
}

Task<void> Faulty::send(Piece piece) {
    const std::uint64_t before = position();
    for (const FaultEvent& event : piece.events) line().annotate(comment_of(event));
    if (piece.hang_up) line().hang_up(piece.to);
    const bool missing = piece.bytes.empty() && (!piece.events.empty() || piece.hang_up);
    if (line().has_driver()) in_flight_ += piece.bytes.size();
    line().speak_at(piece.line_rate);
    if (!missing) co_await line().write(piece.bytes, piece.to);
    const std::uint64_t gone = position() - before;
    for (const FaultEvent& event : piece.events) {
        const bool seen =
            is_missing(event) ? event.offset <= gone && line().has_driver() : event.offset < gone;
        if (seen) record(out_, event, before);
    }
}

/// Some lines hold bytes back for a while, as a USB adapter does.
std::uint64_t Faulty::position() {
    const std::uint64_t out = line().bytes_out() + line().bytes_lost();
    in_flight_ -= std::min(in_flight_, out - seen_out_);
    seen_out_ = out;
    if (!line().has_driver()) in_flight_ = 0;
    return line().bytes_out() + in_flight_;
}

Task<void> Faulty::keep_hearing() {
    while (!closed_) {
        co_await in_bell_.until(in_.next_due().value_or(Time::max()));
        if (!closed_) hear_what_is_due();
    }
}

void Faulty::hear_what_is_due() {
    while (const auto piece = in_.take(clock_.now())) hear(*piece);
}

void Faulty::hear(const Piece& piece) {
    for (const FaultEvent& event : piece.events) record(in_, event, heard_);
    heard_ += piece.bytes.size();
    const bool missing = piece.bytes.empty() && !piece.events.empty();
    if (!missing) events_.received(piece.bytes, piece.to);
}

void Faulty::record(const Pieces& pieces, const FaultEvent& event, std::uint64_t base) {
    FaultEvent placed = event;
    placed.offset += base;
    if (several_) placed.details.emplace_back("driver", to_text(driver_));
    faults_.record(clock_.now(), pieces.place(), placed);
}

void Faulty::unplug() {
    out_.clear();
    in_.clear();
    line().unplug();
}

void Faulty::forget() {
    out_.clear();
    in_.clear();
    line().forget();
}

void Faulty::faults_changed() {
    if (!faults_.any()) {
        out_.hurry(clock_.now());
        in_.hurry(clock_.now());
    }
    out_bell_.cancel();
    in_bell_.cancel();
}

void Faulty::close() {
    closed_ = true;
    out_bell_.cancel();
    in_bell_.cancel();
    line().close();
}

}  // namespace echoloop
