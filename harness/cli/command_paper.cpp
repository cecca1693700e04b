#include "harness/cli/command_paper.h"

#include <iostream>

#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/run/claims.h"
#include "harness/run/paper_items.h"

namespace trammel::harness {

int paper_command(const std::string& results) {
  const Document claim_set = load_claims();
  std::vector<results::PaperItem> items = load_paper_items(claim_set, Catalogue());
  if (!results.empty())
    judge_paper_items(results::read_results(std::filesystem::path(results)), items);
  const Json& claims = claim_set.value().at("claims");
  for (const results::PaperItem& item : items) {
    std::cout << item.id << " (" << item.section << "): " << item.what << '\n';
    for (const auto& shown : item.shown_by) {
      std::cout << "    " << shown.case_id << (shown.variant.empty() ? "" : ":" + shown.variant);
      for (const std::string& part : {shown.quantity, shown.figure})
        if (!part.empty()) std::cout << "  " << part;
      std::cout << (shown.verdict.empty() ? "" : ": " + shown.verdict) << '\n';
    }
    for (const std::string& claim : item.claims)
      std::cout << "    claim " << claim << ": "
                << claims.at(claim).at("expected").get<std::string>() << '\n';
    for (const std::string& text : {item.reason, item.note})
      if (!text.empty()) std::cout << wrapped(text, "    ");
  }
  return 0;
}

}  // namespace trammel::harness
