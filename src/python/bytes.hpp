// Serialises values of scenes for pickles: all members, and shared objects once. The bytes are for the same
// version of the library on the same kind of machine.
#pragma once

#include "python/members.hpp"
#include "python/mesh.hpp"
#include "python/python_scene.hpp"

#include "celltrace/error.hpp"
#include "celltrace/version.hpp"

#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <array>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace celltrace {

/// True if a value is serialised as its bytes. Types with padding are visited by member.
template <class T>
inline constexpr bool kIsBytes =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Vec3> || std::is_same_v<T, Vec3f> ||
    std::is_same_v<T, Vec2f> || std::is_same_v<T, std::array<double, 4>> ||
    std::is_same_v<T, std::array<std::uint16_t, 4>> || std::is_same_v<T, Mesh::Triangle> || std::is_same_v<T, Mesh::Coordinates>;

/// Passes all members of a value to an archive, in their order.
template <class Archive, class T> void visit_members(Archive& archive, T& value) {
  std::apply([&](auto&... member) { (archive(member), ...); }, tie_members(value));
}
/// Leaves out PythonScene::placed_colours, which are found by address and so differ between processes.
template <class Archive> void visit_members(Archive& archive, PythonScene& scene) {
  archive(static_cast<Scene&>(scene));
}
template <class Archive> void visit_members(Archive& archive, MeshColours& colours) {
  archive(colours.palette);
  archive(colours.map);
}
template <class Archive> void visit_members(Archive& archive, PythonMesh& mesh) {
  archive(mesh.mesh);
  archive(mesh.colours);
}

class ByteWriter {
public:
  template <class T> void operator()(const T& value) {
    if constexpr (kIsBytes<T>)
      put(&value, sizeof value);
    else
      visit_members(*this, const_cast<T&>(value)); // the archive only reads it
  }
  /// Functions are known to the parser alone.
  void operator()(const std::shared_ptr<const FunctionCode>&) {
    throw InputError("a scene whose textures have functions cannot be pickled");
  }
  template <class T, std::size_t N> void operator()(const T (&values)[N]) {
    for (const T& value : values)
      (*this)(value);
  }
  void operator()(const std::string& text) {
    (*this)(std::uint64_t{text.size()});
    put(text.data(), text.size());
  }
  template <class T> void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    if constexpr (kIsBytes<T>)
      put(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values)
        (*this)(value);
  }
  template <class T> void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }
  template <class... T> void operator()(const std::variant<T...>& value) {
    (*this)(static_cast<std::uint8_t>(value.index()));
    std::visit(*this, value);
  }
  /// Writes a number for each shared object, 0 for none, followed by the object the first time.
  template <class T> void operator()(const std::shared_ptr<const T>& shared) {
    const auto [place, is_new] = numbers_.try_emplace(shared.get(), numbers_.size() + 1);
    (*this)(shared ? place->second : std::uint64_t{0});
    if (!shared)
      numbers_.erase(place);
    else if (is_new)
      (*this)(*shared);
  }
  std::string take() { return std::move(bytes_); }

private:
  void put(const void* data, std::size_t count) {
    if (count) bytes_.append(static_cast<const char*>(data), count);
  }

  std::string bytes_;
  std::unordered_map<const void*, std::uint64_t> numbers_;
};

/// Reads values. Throws InputError for bytes that no ByteWriter has written.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T> void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      get(&byte, 1);
      value = byte != 0;
    } else if constexpr (kIsBytes<T>) {
      get(&value, sizeof value);
    } else {
      visit_members(*this, value);
    }
  }
  template <class T, std::size_t N> void operator()(T (&values)[N]) {
    for (T& value : values)
      (*this)(value);
  }
  void operator()(std::string& text) {
    text.resize(count_of(1));
    get(text.data(), text.size());
  }
  template <class T> void operator()(std::vector<T>& values) {
    values.clear();
    if constexpr (kIsBytes<T>) {
      values.resize(count_of(sizeof(T)));
      get(values.data(), values.size() * sizeof(T));
    } else {
      for (std::size_t left = count_of(1); left > 0; --left)
        (*this)(values.emplace_back());
    }
  }
  template <class T> void operator()(std::optional<T>& value) {
    bool is_there = false;
    (*this)(is_there);
    value.reset();
    if (is_there) (*this)(value.emplace());
  }
  template <class... T> void operator()(std::variant<T...>& value) {
    std::uint8_t index = 0;
    (*this)(index);
    if (index >= sizeof...(T)) fail();
    read_alternative(value, index, std::index_sequence_for<T...>());
  }
  void operator()(std::shared_ptr<const FunctionCode>&) { fail(); }
  template <class T> void operator()(std::shared_ptr<const T>& shared) {
    std::uint64_t number = 0;
    (*this)(number);
    if (number > read_.size() + 1) fail();
    if (number == 0) {
      shared.reset();
    } else if (number <= read_.size() && read_[number - 1].second) {
      if (read_[number - 1].first != std::type_index(typeid(T))) fail();
      shared = std::static_pointer_cast<const T>(read_[number - 1].second);
    } else if (number == read_.size() + 1) {
      constexpr int kDeepest = 1000;
      if (++depth_ > kDeepest) fail();
      read_.emplace_back(typeid(T), nullptr); // numbers follow the order in which objects begin
      auto made = std::make_shared<T>();
      (*this)(*made);
      read_[number - 1].second = made;
      shared = std::move(made);
      --depth_;
    } else {
      fail();
    }
  }
  void end() const {
    if (!rest_.empty()) fail();
  }

private:
  [[noreturn]] static void fail() { throw InputError("this is no pickle of this version of celltrace"); }
  void get(void* data, std::size_t count) {
    if (count > rest_.size()) fail();
    if (count) std::memcpy(data, rest_.data(), count);
    rest_.remove_prefix(count);
  }
  /// Reads a count of things that have at least `bytes` bytes each.
  std::size_t count_of(std::size_t bytes) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > rest_.size() / bytes) fail();
    return count;
  }
  template <class... T, std::size_t... I>
  void read_alternative(std::variant<T...>& value, std::size_t index, std::index_sequence<I...>) {
    ((index == I ? (*this)(value.template emplace<I>()) : void()), ...);
  }

  std::string_view rest_;
  std::vector<std::pair<std::type_index, std::shared_ptr<const void>>> read_;
  int depth_ = 0;
};

template <class T> std::string to_bytes(const T& value) {
  ByteWriter writer;
  writer(std::string(version()));
  writer(value);
  return writer.take();
}
template <class T> T from_bytes(std::string_view bytes) {
  ByteReader reader(bytes);
  std::string by;
  reader(by);
  if (by != version())
    throw InputError("this is a pickle of another version of celltrace than " + std::string(version()));
  T value;
  reader(value);
  reader.end();
  return value;
}

} // namespace celltrace
