// libFuzzer's way to have inputs changed by us: only so do checksums stay right.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {
// libFuzzer's own mutation, in place; the new size.
std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);
// Ours, which a program that has it uses instead.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned seed);
}
