// An array for large loops: the threads that fill it also take its memory.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace echoloop {

/// Elements have no value until one is written: a vector would first write zeros, all on one thread.
template <typename T>
class Scratch {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  public:
    explicit Scratch(std::size_t size) : size_(size), first_(std::allocator<T>().allocate(size)) {}
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() { std::allocator<T>().deallocate(first_, size_); }

    std::size_t size() const { return size_; }
    T& operator[](std::size_t i) { return first_[i]; }
    const T& operator[](std::size_t i) const { return first_[i]; }
    std::span<T> all() { return {first_, size_}; }
    std::span<const T> all() const { return {first_, size_}; }

  private:
    std::size_t size_;
    T* first_;
};

}  // namespace echoloop
