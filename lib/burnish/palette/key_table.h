// A hash table from 64-bit keys to 32-bit numbers: open addressing, no removal.
#pragma once

#include <cstdint>
#include <vector>

namespace burnish {

class KeyTable {
 public:
  static constexpr int kAhead = 12;  // keys to be between a prefetch and the use of its slot

  KeyTable() : slots_(1 << 12), shift_(64 - 12) {}

  std::size_t size() const { return size_; }

  // Room for so many keys. To be called before another table's keys are taken over: for_each gives them in the order of
  // their hashes, which crowds the front of a smaller table until it grows.
  void reserve(std::size_t keys) {
    while (is_full(keys)) grow();
  }

  // The number of a key, 0 when it is new. The reference holds until the next call. Keys are below 2^64 − 1.
  std::uint32_t& operator[](std::uint64_t key) {
    if (is_full(size_)) grow();
    Slot& slot = slots_[find(key)];
    if (slot.key == kFree) slot.key = key, size_++;
    return slot.value;
  }
  // The number of a key that is there.
  std::uint32_t at(std::uint64_t key) const { return slots_[find(key)].value; }

  // Brings a key's slot near; looking keys up one by one is waiting for memory.
  void prefetch(std::uint64_t key) const { __builtin_prefetch(&slots_[home(key)]); }

  template <typename Body>
  void for_each(const Body& body) const {
    for (const Slot& s : slots_)
      if (s.key != kFree) body(s.key, s.value);
  }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t(0);
  struct Slot {
    std::uint64_t key = kFree;
    std::uint32_t value = 0;
  };
  // Beyond ⅝ probing becomes long; ½ would double the table where powers of two are all that is kept.
  bool is_full(std::size_t keys) const { return 8 * keys >= 5 * slots_.size(); }
  std::size_t home(std::uint64_t key) const { return (key * 0x9e3779b97f4a7c15u) >> shift_; }
  std::size_t find(std::uint64_t key) const {
    std::size_t i = home(key);
    while (slots_[i].key != key && slots_[i].key != kFree) i = (i + 1) & (slots_.size() - 1);
    return i;
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    shift_--;
    for (const Slot& s : old)
      if (s.key != kFree) slots_[find(s.key)] = s;
  }

  std::vector<Slot> slots_;
  int shift_;
  std::size_t size_ = 0;
};

}  // namespace burnish
