#include "harness/base/json_file.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <new>
#include <unordered_set>

#include "harness/base/errors.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr std::size_t kMaxDepth = 100;

/// Builds a JSON document while reading, and throws at the first error.
class StrictReader : public nlohmann::json_sax<Json> {
 public:
  explicit StrictReader(std::string name) : name_(std::move(name)) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& token) override {
    const std::string mantissa = token.substr(0, token.find_first_of("eE"));
    if (value == 0 && mantissa.find_first_of("123456789") != std::string::npos)
      throw InputError(name_, here(),
                       "expected 0 or a number that is not rounded to 0 as a double (got '" +
                           printable(token, 30) + "')");
    return add(value);
  }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    auto& members = open_.back()->get_ref<Json::object_t&>();
    if (is_known(members, name))
      throw InputError(name_, (pointer() / name).to_string(),
                       "expected every key once (got '" + printable(name) + "' twice)");
    // The member is appended directly, because operator[] would search all keys once more.
    auto& container = static_cast<Json::object_t::Container&>(members);
    make_room(container);
    member_ = &container.emplace_back(name, nullptr).second;
    return true;
  }

  bool parse_error(std::size_t, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    const std::string got = " (got '" + printable(token, 30) + "')";
    const std::string what = error.what(), head = "parse error at ";
    const std::size_t place = what.find(head);
    if (place == std::string::npos) {  // the error is a number out of range
      throw InputError(name_, here(), "expected a number within the range of a double" + got);
    }
    const std::size_t start = place + head.size();  // "line 1, column 5: ..."
    throw InputError(
        name_ + ": " + what.substr(start, what.find(':', start) - start) +
        (what.find("UTF-8") == std::string::npos ? ": expected JSON" : ": expected JSON in UTF-8") +
        got);
  }

  Json take() { return std::move(root_); }

 private:
  /// Returns true if the innermost open object contains the key `name`. Large objects use a set,
  /// which makes objects with 100,000 members feasible.
  bool is_known(const Json::object_t& members, const std::string& name) {
    constexpr std::size_t few = 32;
    if (members.size() < few) return members.find(name) != members.end();
    auto& keys = keys_.back();
    if (keys.empty())
      for (const auto& member : members) keys.insert(member.first);
    return !keys.insert(name).second;
  }
  /// Reserves memory for one more member of a JSON object. A vector that grows automatically would
  /// copy all members, because their constant keys cannot be moved.
  static void make_room(Json::object_t::Container& members) {
    if (members.size() < members.capacity()) return;
    Json::object_t::Container more;
    more.reserve(2 * members.size() + 4);
    for (auto& [name, value] : members) more.emplace_back(name, std::move(value));
    members.swap(more);
  }
  /// Returns the pointer of the innermost open object or array.
  [[nodiscard]] JsonPointer pointer() const {
    JsonPointer path;
    for (std::size_t i = 1; i < open_.size(); ++i) path = path / last_step(*open_[i - 1]);
    return path;
  }
  [[nodiscard]] static std::string last_step(const Json& open) {
    return open.is_object() ? std::prev(open.end()).key() : std::to_string(open.size() - 1);
  }
  /// Returns the JSON pointer of the next value to be read.
  [[nodiscard]] std::string here() const {
    if (open_.empty()) return "";
    const Json& last = *open_.back();
    return (last.is_object() ? pointer() / last_step(last) : pointer() / last.size()).to_string();
  }
  Json* place(Json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    if (open_.back()->is_object()) return &(*member_ = std::move(value));
    return &open_.back()->emplace_back(std::move(value));
  }
  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json empty) {
    if (open_.size() == kMaxDepth)
      throw InputError(name_, here(),
                       "expected at most " + std::to_string(kMaxDepth) + " levels of nesting");
    open_.push_back(place(std::move(empty)));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  std::string name_;
  Json root_;
  Json* member_ = nullptr;   ///< value of the key read last
  std::vector<Json*> open_;  ///< open objects and arrays, from the root inward
  std::vector<std::unordered_set<std::string>> keys_;  ///< keys of each large open object
};

}  // namespace

Json parse_json(const std::string& text, const std::string& name) {
  StrictReader reader(name);
  Json::sax_parse(text, &reader);
  // The parser would ignore all text after a null character.
  if (const std::size_t at = text.find('\0'); at != std::string::npos)
    throw InputError(name + ": expected no null character (got '\\u0000' at byte " +
                     std::to_string(at + 1) + ")");
  return reader.take();
}

Json parse_cbor(const std::string& bytes) {
  StrictReader reader("CBOR");
  Json::sax_parse(bytes, &reader, Json::input_format_t::cbor);
  return reader.take();
}

std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 28;
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(file, error);  // opening a pipe may block
  std::ifstream in;
  if (regular) in.open(file, std::ios::binary);
  if (!in.is_open()) throw InputError(file.string() + ": expected a readable file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > most) throw InputError(file.string() + ": expected a file of up to 256 MiB");
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

Json read_json(const std::filesystem::path& file) {
  try {
    return parse_json(read_text(file), file.string());
  } catch (const std::bad_alloc&) {
    throw InputError(file.string() + ": expected a file that fits into memory");
  }
}

namespace {

void append_json(const Json& json, std::size_t depth, std::size_t deepest, std::string& text) {
  // Large files, such as results.json, are written with a limit of the nesting depth (`deepest`).
  // The lines of such files are indented by at most one space, because full indentation would take
  // 2 % of the file size.
  const std::size_t most = deepest < kMaxDepth ? 1 : kMaxDepth;
  const auto line = [&](std::size_t spaces) {
    text.append(1, '\n').append(std::min(spaces, most), ' ');
  };
  const bool nested = json.is_structured() && std::ranges::any_of(json, [](const Json& item) {
                        return item.is_structured();
                      });
  const bool last = json.is_object() && depth + 1 == deepest;
  const bool expanded =
      !json.empty() && depth < deepest && !last && (nested || (json.is_object() && depth < 2));
  const auto one_line = [](const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  if (!expanded) {
    text += one_line(json);
    return;
  }
  text += json.is_object() ? '{' : '[';
  bool first = true;
  for (const auto& item : json.items()) {
    if (!first) text += ',';
    first = false;
    line(depth + 1);
    if (json.is_object()) text += one_line(item.key()) + ": ";
    append_json(item.value(), depth + 1, deepest, text);
  }
  line(depth);
  text += json.is_object() ? '}' : ']';
}

/// Returns true for a device, a pipe, or a file that is an open stream such as /dev/stdout.
bool is_written_in_place(std::filesystem::path file) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) return true;
  for (int links = 0; links < 40; ++links) {
    const std::string path = std::filesystem::absolute(file, ignored).string();
    if (path.starts_with("/dev/") || path.starts_with("/proc/")) return true;
    if (!std::filesystem::is_symlink(file, ignored)) return false;
    file = file.parent_path() / std::filesystem::read_symlink(file, ignored);
  }
  return false;
}

}  // namespace

std::string format_json(const Json& json, std::size_t max_multiline_depth) {
  std::string text;
  append_json(json, 0, max_multiline_depth, text);
  return text + "\n";
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  static std::atomic<unsigned> count{0};
  std::error_code error, ignored;
  const bool in_place = is_written_in_place(file);
  std::filesystem::path part = file;
  if (!in_place) part += ".part-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  errno = 0;
  std::ofstream out(part, std::ios::binary);
  out << text;
  out.close();
  const int cause = errno != 0 ? errno : EIO;  // for example ENOSPC for a full disk
  if (out && !in_place) std::filesystem::rename(part, file, error);
  if (out && !error) return;
  if (!out) error.assign(cause, std::generic_category());
  if (!in_place) std::filesystem::remove(part, ignored);
  throw InputError(file.string() + ": cannot be written (" + error.message() +
                   "); expected a writable file or folder");
}

}  // namespace trammel::harness
