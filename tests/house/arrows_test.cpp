// Tests that sources only include headers of rooms (folders) that CONTRIBUTING.md permits.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(arrows)

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = TRAMMEL_SOURCE_DIR;
constexpr std::size_t kFilesInRoom = 32;

using Cells = std::vector<std::string>;

std::vector<std::string> lines_of_file(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Cells cells_of_table_row(const std::string& line) {
  Cells cells;
  for (std::size_t at = 1, end; (end = line.find(" |", at)) != std::string::npos; at = end + 2)
    cells.push_back(end > at ? line.substr(at + 1, end - at - 1) : "");
  return cells;
}

/// Returns the rows of the first Markdown table in a file whose header begins with these words.
std::vector<Cells> table(const fs::path& file, const std::string& head) {
  std::vector<Cells> rows;
  bool inside = false;
  for (const std::string& line : lines_of_file(file)) {
    if (line.rfind(head, 0) == 0) {
      inside = true;
    } else if (inside && line.rfind("|", 0) != 0) {
      break;
    } else if (inside && line.rfind("|---", 0) != 0) {
      rows.push_back(cells_of_table_row(line));
    }
  }
  return rows;
}

/// Returns the texts between backquotes.
std::vector<std::string> names_in_backquotes(const std::string& cell) {
  static const std::regex name("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator at(cell.begin(), cell.end(), name), end; at != end; ++at)
    names.push_back((*at)[1]);
  return names;
}

std::string first_path_component(const std::string& path) {
  return path.substr(0, path.find('/'));
}

bool lies_in(const std::string& path, const std::string& folder) {
  return path == folder || path.rfind(folder + "/", 0) == 0;
}

bool is_code(const fs::path& file) {
  return file.extension() == ".h" || file.extension() == ".cpp";
}

/// Table of rooms (source folders). Files may include headers of their room, of the rooms in the
/// table row of their room, and of rooms that those rooms may include. A row for a single file
/// replaces the row of its room.
struct Rooms {
  std::vector<std::string> order;
  std::map<std::string, std::string> arrows;  ///< the last cell of each row, as written
  std::map<std::string, std::set<std::string>> direct, all;

  [[nodiscard]] std::set<std::string> tops() const {
    std::set<std::string> found;
    for (const std::string& room : order) found.insert(first_path_component(room));
    return found;
  }

  /// Returns the name of the table row that applies to a file, or an empty text.
  [[nodiscard]] std::string row_of(const std::string& file) const {
    const std::string folder = fs::path(file).parent_path().generic_string();
    return arrows.count(file) > 0 ? file : arrows.count(folder) > 0 ? folder : "";
  }
};

/// Resolves a name in a table row to rooms: a room of the same top folder, a room with its full
/// path, or a top folder for all its rooms.
std::vector<std::string> resolve(const std::string& name, const std::string& room,
                                 const std::vector<std::string>& order) {
  const auto has = [&](const std::string& key) {
    return std::find(order.begin(), order.end(), key) != order.end();
  };
  const std::string near = first_path_component(room) + "/" + name;
  if (has(near)) return {near};
  std::vector<std::string> found;
  for (const std::string& other : order)
    if (lies_in(other, name)) found.push_back(other);
  return found;
}

const Rooms& rooms() {
  static const Rooms read = [] {
    Rooms rooms;
    const auto rows = table(kRoot / "CONTRIBUTING.md", "| room |");
    for (const Cells& cells : rows) {
      rooms.order.push_back(names_in_backquotes(cells.at(0)).at(0));
      rooms.arrows[rooms.order.back()] = cells.at(2);
    }
    for (const std::string& room : rooms.order) {
      std::set<std::string>& all = rooms.all[room];
      all.insert(room);
      for (const std::string& name : names_in_backquotes(rooms.arrows[room]))
        for (const std::string& target : resolve(name, room, rooms.order)) {
          rooms.direct[room].insert(target);
          all.insert(rooms.all[target].begin(), rooms.all[target].end());
        }
    }
    return rooms;
  }();
  return read;
}

/// Returns the external headers that each top folder must not include. A header is named by the
/// first part of its paths.
std::map<std::string, std::set<std::string>> forbidden() {
  std::map<std::string, std::set<std::string>> found;
  for (const Cells& cells : table(kRoot / "CONTRIBUTING.md", "| folder | must not include |")) {
    const auto names = names_in_backquotes(cells.at(1));
    found[names_in_backquotes(cells.at(0)).at(0)] = {names.begin(), names.end()};
  }
  return found;
}

/// Returns the paths of all sources and headers outside tests/, docs/ and build folders, relative
/// to the root.
std::vector<std::string> code() {
  std::vector<std::string> files;
  for (const auto& top : fs::directory_iterator(kRoot)) {
    const std::string name = top.path().filename().string();
    if (!top.is_directory() || name[0] == '.' || name == "tests" || name == "build" ||
        name == "docs")
      continue;
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      if (is_code(entry.path()))
        files.push_back(fs::relative(entry.path(), kRoot).generic_string());
    }
  }
  return files;
}

}  // namespace

BOOST_AUTO_TEST_CASE(folder_includes_only_folders_above_it_in_the_table) {
  BOOST_TEST(rooms().order.size() > 20U);
  std::set<std::string> above;
  for (const std::string& room : rooms().order) {
    BOOST_TEST(fs::exists(kRoot / room), "there is no " << room);
    BOOST_TEST(above.count(room) == 0U, room << " has two rows");
    for (const std::string& name : names_in_backquotes(rooms().arrows.at(room)))
      BOOST_TEST(!resolve(name, room, rooms().order).empty(), room << " names " << name);
    const auto direct = rooms().direct.find(room);
    if (direct != rooms().direct.end())
      for (const std::string& target : direct->second)
        BOOST_TEST(above.count(target) == 1U, target << " is not above " << room);
    above.insert(room);
  }
}

BOOST_AUTO_TEST_CASE(every_include_obeys_the_folder_dependencies) {
  const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  const std::set<std::string> tops = rooms().tops();
  const auto outside = forbidden();
  for (const std::string& top : tops) BOOST_TEST(outside.count(top) == 1U, top);
  for (const std::string& file : code()) {
    const std::string room = rooms().row_of(file);
    BOOST_TEST(!room.empty(), file << " is in no room of CONTRIBUTING.md");
    if (room.empty()) continue;
    for (const std::string& line : lines_of_file(kRoot / file)) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      const std::string target = match[1], part = first_path_component(target);
      const bool own = part != target && (tops.count(part) > 0 || part == "tests");
      const bool allowed = own ? rooms().all.at(room).count(rooms().row_of(target)) > 0
                               : outside.at(first_path_component(room)).count(part) == 0;
      BOOST_TEST(allowed, file << " must not include " << target);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_folder_has_too_many_files) {
  std::map<std::string, std::size_t> files;
  for (const std::string& file : code()) ++files[fs::path(file).parent_path().generic_string()];
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "cases"))
    if (entry.is_regular_file()) ++files[entry.path().parent_path().generic_string()];
  BOOST_TEST(files.size() > 20U);
  for (const auto& [room, count] : files)
    BOOST_TEST(count <= kFilesInRoom, room << " holds " << count << " files");
}

BOOST_AUTO_TEST_CASE(readme_lists_the_subfolders_and_their_dependencies) {
  for (const std::string& top : rooms().tops()) {
    std::map<std::string, std::string> listed;
    for (const Cells& cells : table(kRoot / top / "README.md", "| room |"))
      listed[top + "/" + names_in_backquotes(cells.at(0)).at(0)] = cells.back();
    for (const std::string& room : rooms().order) {
      if (first_path_component(room) != top) continue;
      BOOST_TEST(listed.count(room) == 1U, top << "/README.md has no row for " << room);
      BOOST_TEST(listed[room] == rooms().arrows.at(room), room << " in " << top << "/README.md");
      listed.erase(room);
    }
    for (const auto& [room, arrows] : listed)
      BOOST_TEST(false, top << "/README.md names " << room << ", CONTRIBUTING.md does not");
  }
}

// The linker would merge two different types with the same name, which corrupts memory.
BOOST_AUTO_TEST_CASE(types_of_a_namespace_have_unique_names) {
  static const std::regex space("^namespace (trammel\\S*) \\{"),
      type("^(struct|class|enum class) (\\w+)(<.*>)? (: .*)?\\{.*");
  std::map<std::string, std::string> first;
  for (const std::string& top : rooms().tops())
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (entry.path().extension() != ".h") continue;
      std::string inside;
      std::smatch found;
      for (const std::string& line : lines_of_file(entry.path())) {
        if (std::regex_match(line, found, space)) inside = found[1];
        if (!std::regex_match(line, found, type) || found[3].matched) continue;
        const auto [known, fresh] = first.emplace(inside + "::" + found[2].str(), entry.path());
        BOOST_TEST(fresh, known->first << " in " << known->second << " and " << entry.path());
      }
    }
  BOOST_TEST(first.size() > 100U);
}

BOOST_AUTO_TEST_CASE(test_folders_mirror_the_code_folders) {
  const std::set<std::string> tops = rooms().tops();
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    if (!is_code(entry.path())) continue;
    const fs::path folder = fs::relative(entry.path().parent_path(), kRoot / "tests");
    const std::string name = folder.generic_string();
    if (tops.count(first_path_component(name)) == 0) continue;
    const bool mirrored = name != first_path_component(name) &&
                          std::any_of(rooms().order.begin(), rooms().order.end(),
                                      [&](const std::string& room) { return lies_in(room, name); });
    BOOST_TEST(mirrored, "tests/" << name << " mirrors no room");
  }
}

BOOST_AUTO_TEST_CASE(readme_of_the_tests_lists_their_folders) {
  std::set<std::string> listed, there;
  for (const Cells& cells : table(kRoot / "tests/README.md", "| folder |"))
    for (const std::string& name : names_in_backquotes(cells.at(0))) listed.insert(name);
  for (const auto& entry : fs::directory_iterator(kRoot / "tests"))
    if (entry.is_directory()) there.insert(entry.path().filename().string());
  BOOST_TEST(listed == there, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
