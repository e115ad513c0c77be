#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace fsi {

/// Consecutive numbers of a vector owned elsewhere, as C++20's std::span: code for whole vectors works on a part of one
/// in place. A view of const numbers is read-only.
template <class T>
class VectorView {
  using Value = std::remove_const_t<T>;

 public:
  VectorView() = default;
  VectorView(T* data, std::size_t size) : data_(data), size_(size) {}
  VectorView(std::vector<Value>& whole) : data_(whole.data()), size_(whole.size()) {}
  template <class U = T, class = std::enable_if_t<std::is_const_v<U>>>
  VectorView(const std::vector<Value>& whole) : data_(whole.data()), size_(whole.size()) {}
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
  VectorView(VectorView<U> other) : data_(other.data()), size_(other.size()) {}

  T* data() const { return data_; }
  std::size_t size() const { return size_; }
  T* begin() const { return data_; }
  T* end() const { return data_ + size_; }
  T& operator[](std::size_t i) const { return data_[i]; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace fsi
