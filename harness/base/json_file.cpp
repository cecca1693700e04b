#include "harness/base/json_file.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "harness/base/errors.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr std::size_t kMaxDepth = 100;

/// Walks through a text without building it, and notes the first thing that is wrong.
class StrictReader : public nlohmann::json_sax<Json> {
 public:
  StrictReader(std::string file, const std::string& text) : file_(std::move(file)), text_(text) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.step = name;
    if (level.keys.insert(name).second) return true;
    throw InputError(file_, pointer(),
                     "expected every key once (got '" + printable(name) + "' twice)");
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    const std::size_t offset = position > 0 ? position - 1 : 0;  // of the last byte read
    const std::string what = error.what();
    const bool overflow = what.find("out_of_range") != std::string::npos;
    throw InputError(file_ + ": " + place_of(offset) + ": expected " +
                     (overflow ? "a number that a double can hold" : "JSON") + " (got '" +
                     printable(token, 30) + "')");
  }

 private:
  struct Level {
    bool object = false;
    std::set<std::string> keys;
    std::string step;
    std::size_t items = 0;
  };

  /// Where a byte stands, as an editor counts.
  [[nodiscard]] std::string place_of(std::size_t offset) const {
    const std::string before = text_.substr(0, std::min(offset, text_.size()));
    const auto line = std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    return "line " + std::to_string(line + 1) + ", column " +
           std::to_string(before.size() - start + 1);
  }
  [[nodiscard]] std::string pointer() const {
    JsonPointer path;
    for (const Level& level : levels_) path /= level.step;
    return path.to_string();
  }
  bool value() {
    if (!levels_.empty() && !levels_.back().object) {
      levels_.back().step = std::to_string(levels_.back().items++);
    }
    return true;
  }
  bool open(bool object) {
    value();
    if (levels_.size() == kMaxDepth) {
      throw InputError(file_, pointer(),
                       "expected at most " + std::to_string(kMaxDepth) + " levels of nesting");
    }
    levels_.push_back({object, {}, {}, 0});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string file_;
  const std::string& text_;
  std::vector<Level> levels_;
};

}  // namespace

Json parse_json(const std::string& text, const std::string& name) {
  StrictReader reader(name, text);
  Json::sax_parse(text, &reader);
  return Json::parse(text);
}

Json read_json(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, ignored)) {
    throw InputError(file.string() + ": expected a readable file");
  }
  std::ostringstream text;
  text << in.rdbuf();
  return parse_json(text.str(), file.string());
}

namespace {

void put(const Json& json, std::size_t depth, std::string& text) {
  const auto line = [&](std::size_t spaces) { text += '\n' + std::string(spaces, ' '); };
  const bool nested =
      json.is_structured() &&
      std::any_of(json.begin(), json.end(), [](const Json& item) { return item.is_structured(); });
  const bool expanded = !json.empty() && (nested || (json.is_object() && depth < 2));
  if (!expanded) {
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  text += json.is_object() ? '{' : '[';
  bool first = true;
  for (const auto& item : json.items()) {
    if (!first) text += ',';
    first = false;
    line(depth + 1);
    if (json.is_object()) {
      text += Json(item.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    }
    put(item.value(), depth + 1, text);
  }
  line(depth);
  text += json.is_object() ? '}' : ']';
}

}  // namespace

std::string pretty(const Json& json) {
  std::string text;
  put(json, 0, text);
  return text + "\n";
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.flush();
    if (!out) throw InputError(file.string() + ": expected a place that can be written");
  }
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) throw InputError(file.string() + ": expected a place that can be written");
}

}  // namespace trammel::harness
