// Replaces operator new for the whole test program; in a file of its own, so that compilers see no mismatched
// pair.
#include "tests/protocols/allocations.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace echoloop {
std::size_t largest_allocation = 0;
}

void* operator new(std::size_t size) {
    echoloop::largest_allocation = std::max(echoloop::largest_allocation, size);
    if (void* block = std::malloc(size)) return block;
    throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
