// A transport around another one that passes everything on as it is. What a decorator changes, it overrides.
#pragma once

#include "emulator/transport/transport.h"

namespace echoloop {

class Decorator : public Transport {
  public:
    explicit Decorator(std::unique_ptr<Transport> line) : line_(std::move(line)) {}

    void start(Events events) override { line_->start(std::move(events)); }
    Task<void> write(ByteView bytes, Address to) override { return line_->write(bytes, to); }
    void speak_at(double rate) override { line_->speak_at(rate); }
    void cut_off() override { line_->cut_off(); }
    void hang_up(Address to) override { line_->hang_up(to); }
    bool has_driver() const override { return line_->has_driver(); }
    void annotate(const std::string& remark) override { line_->annotate(remark); }
    void annotate_received(const std::string& remark) override { line_->annotate_received(remark); }
    void unplug() override { line_->unplug(); }
    void plug() override { line_->plug(); }
    void reset() override { line_->reset(); }
    void forget() override { line_->forget(); }
    void reset_forgotten() override { line_->reset_forgotten(); }
    void close() override { line_->close(); }
    void settle() override { line_->settle(); }
    std::string describe() const override { return line_->describe(); }
    Wire wire() const override { return line_->wire(); }
    std::vector<std::string> connected() const override { return line_->connected(); }
    uart::Receiver far_end() const override { return line_->far_end(); }
    double line_rate() const override { return line_->line_rate(); }
    std::uint64_t bytes_in() const override { return line_->bytes_in(); }
    std::uint64_t bytes_out() const override { return line_->bytes_out(); }
    std::uint64_t bytes_lost() const override { return line_->bytes_lost(); }
    std::uint64_t messages_dropped() const override { return line_->messages_dropped(); }

  protected:
    Transport& line() { return *line_; }
    const Transport& line() const { return *line_; }

  private:
    std::unique_ptr<Transport> line_;
};

}  // namespace echoloop
