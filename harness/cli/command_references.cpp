#include "harness/cli/command_references.h"

#include <algorithm>
#include <iostream>

#include "harness/base/data_root.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/input/reference_library.h"

namespace trammel::harness {
namespace {

void print_csv(const std::vector<CitedReference>& all) {
  std::cout << "id,title,kind,unit,index,value,uncertainty,printed,source,place,notes\n";
  for (const auto& [reference, source] : all) {
    for (std::size_t i = 0; i < reference.values.size(); ++i) {
      const std::string printed = reference.printed.empty() ? "" : reference.printed[i];
      std::cout << csv_cell(reference.id) << ',' << csv_cell(reference.title) << ','
                << to_string(reference.kind) << ',' << csv_cell(reference.unit) << ',' << i << ','
                << shortest(reference.values[i]) << ',' << shortest(reference.uncertainty[i]) << ','
                << printed << ',' << csv_cell(source.text) << ',' << csv_cell(reference.place)
                << ',' << csv_cell(reference.notes) << "\n";
    }
  }
}

void print_json(const std::vector<CitedReference>& all) {
  Json json = Json::array();
  for (const auto& [reference, source] : all) {
    json.push_back({{"id", reference.id},
                    {"title", reference.title},
                    {"kind", to_string(reference.kind)},
                    {"unit", reference.unit},
                    {"values", reference.values},
                    {"uncertainty", reference.uncertainty},
                    {"source", source.text},
                    {"place", reference.place}});
    if (!reference.printed.empty()) json.back()["printed"] = reference.printed;
    if (!reference.notes.empty()) json.back()["notes"] = reference.notes;
    if (!reference.derivation.empty()) json.back()["derivation"] = reference.derivation;
    if (!reference.errata.empty()) json.back()["errata"] = reference.errata;
  }
  std::cout << pretty(json);
}

void print_reference(const CitedReference& cited) {
  const auto& [reference, source] = cited;
  std::cout << reference.id << ": " << reference.title << "\n  " << to_string(reference.kind)
            << ", " << source.text << "\n  " << reference.place << '\n';
  if (!reference.derivation.empty()) std::cout << "  " << reference.derivation << '\n';
  if (!reference.notes.empty()) std::cout << "  " << reference.notes << '\n';
  for (const std::string& erratum : reference.errata) std::cout << "  erratum: " << erratum << '\n';
  Table table({"index", ">value [" + reference.unit + "]", ">uncertainty"});
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    table.add({std::to_string(i),
               reference.printed.empty() ? shortest(reference.values[i]) : reference.printed[i],
               rounded(reference.uncertainty[i], 2)});
  }
  table.print(std::cout, "  ");
}

void print_table(const std::vector<CitedReference>& all) {
  Table table({"reference", "kind", ">values", "unit", "source", "title"});
  for (const auto& [reference, source] : all)
    table.add({reference.id, to_string(reference.kind), std::to_string(reference.values.size()),
               reference.unit, reference.source, reference.title});
  table.print(std::cout);
  std::cout << all.size() << (all.size() == 1 ? " reference\n" : " references\n");
}

}  // namespace

int list_references(const std::vector<std::string>& names, ReferenceFormat format) {
  const auto files = references::reference_files((data_root() / "references" / "values").string());
  const References library;
  std::vector<std::string> known;
  for (const auto& [id, file] : files) {
    known.push_back(id);
    if (names.empty()) (void)library.add(file);
  }
  for (const std::string& name : names) {
    if (files.count(name) == 0)
      throw InputError("expected a stored reference (got " + quoted(printable(name)) + ")" +
                       did_you_mean(name, known));
    (void)library.add(files.at(name));
  }
  std::vector<CitedReference> all;
  for (const auto& [id, reference] : library.used()) all.push_back(reference);
  if (format == ReferenceFormat::csv) print_csv(all);
  if (format == ReferenceFormat::json) print_json(all);
  if (format == ReferenceFormat::table) {
    if (names.empty())
      print_table(all);
    else
      std::ranges::for_each(all, print_reference);
  }
  return 0;
}

}  // namespace trammel::harness
