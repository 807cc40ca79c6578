#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/section.h"

namespace rinkaku::report {

/// A section as the page shows it.
struct PageSection {
  std::string id;  ///< a word: anchor, and name of the CSV file beside the page
  std::string title;
  std::string failed;  ///< why there is nothing to show; empty: there is
  Section section;
  std::vector<std::string> svgs;  ///< of its plots
};

struct Page {
  std::vector<std::pair<std::string, std::string>> facts;  ///< of machine, versions and run: name and value
  std::vector<std::string> summary;                        ///< what it is, in sentences
  std::vector<PageSection> sections;
};

/// A text as it may stand in HTML, between tags or in quotes.
std::string escaped(std::string_view text);

/// The whole page: nothing is loaded from elsewhere, no scripts; fits a phone, paper, and dark screens.
std::string html(const Page& page);

}  // namespace rinkaku::report
