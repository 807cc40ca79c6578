#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/interrupt.h"
#include "apps/rinkaku/json_output.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/stages/made_folder.h"
#include "report/child.h"
#include "report/machine.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/scratch_folder.h"
#include "report/sections/sections.h"

namespace rinkaku::app {
namespace {

namespace fs = std::filesystem;
using report::ListedSection;

std::vector<ListedSection> chosen(const std::string& names) {
  const auto all = report::all_sections();
  if (names.empty()) return {all.begin(), all.end()};
  std::vector<ListedSection> sections;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    const auto named_so = [&name](const ListedSection& section) { return section.id == name; };
    const auto found = std::find_if(all.begin(), all.end(), named_so);
    if (found == all.end()) {
      std::string known;
      for (const ListedSection& section : all) known += (known.empty() ? "" : ", ") + std::string(section.id);
      throw input_error("--sections", "there is no section '" + name + "'", "choose of: " + known);
    }
    if (std::none_of(sections.begin(), sections.end(), named_so)) sections.push_back(*found);
  }
  return sections;
}

// The folder that was given; else that of the checkout this was built from; else the installed one.
fs::path recordings_folder(const std::string& given, const fs::path& program) {
  std::error_code none;
  if (!given.empty()) {
    if (fs::is_directory(given, none)) return given;
    throw input_error(given, "is no folder", "give the folder 'recordings' of the project with --recordings");
  }
  for (const fs::path& folder : {fs::path(RINKAKU_RECORDINGS), program.parent_path() / "../share/rinkaku/recordings"}) {
    if (fs::is_directory(folder, none)) return folder;
  }
  return {};
}

// Files that appear together, once all of them are whole.
class Outputs {
 public:
  Outputs(const std::string& folder, const std::vector<ListedSection>& sections, bool force)
      : path_(folder), folder_(path_) {
    for (const ListedSection& section : sections) add(std::string(section.id) + ".csv", force);
    add("index.html", force);
  }
  // In the order of the constructor.
  void write(const std::vector<std::string>& contents) {
    for (std::size_t i = 0; i < files_.size(); ++i) files::write_file(files_[i]->open_path(), contents[i]);
    for (const auto& file : files_) file->commit();
  }

 private:
  void add(const std::string& name, bool force) {
    files_.push_back(std::make_unique<files::PendingFile>((path_ / name).string(), force));
  }
  fs::path path_;
  pipeline::MadeFolder folder_;
  std::vector<std::unique_ptr<files::PendingFile>> files_;
};

report::PageSection measured(const ListedSection& listed, const report::Settings& settings) {
  report::PageSection part;
  part.id = listed.id, part.title = listed.title;
  try {
    part.section = listed.measure(settings);
    for (std::size_t i = 0; i < part.section.plots.size(); ++i) {
      part.svgs.push_back(report::svg_plot(part.section.plots[i], part.id + "-" + std::to_string(i), settings.scratch));
    }
  } catch (const std::exception& failure) {
    part.section = {};
    part.svgs.clear();
    part.failed = failure.what();
    std::fprintf(stderr, "rinkaku: note: section %s is left out: %s\n", listed.id, failure.what());
  }
  return part;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void add_facts(report::Page& page, const ReportCall& call, double seconds) {
  page.summary = {
      "Each plot shows error against run time, the less the better of both. What no other method beats in both is "
      "ringed "
      "and joined in yellow: the Pareto front. Bars are quartiles.",
      call.quick ? "A quick run: fewer sizes and repetitions than without --quick, so times spread more."
                 : "Times depend on the machine and on what else it does; errors don't."};
  page.facts = report::machine_facts();
  page.facts.insert(page.facts.begin(), {"rinkaku", RINKAKU_VERSION});
  page.facts.emplace_back("Seed", std::to_string(call.seed));
  page.facts.emplace_back("Took", std::to_string(static_cast<int>(seconds + 0.5)) + " s");
}

}  // namespace

int report(const ReportCall& call) {
  const std::vector<ListedSection> sections = chosen(call.sections);
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  report::Settings settings;
  settings.quick = call.quick;
  settings.seed = static_cast<std::uint64_t>(call.seed);
  settings.recordings = recordings_folder(call.recordings, program);
  settings.rinkaku = program;
  settings.interrupted = &interrupted();
  if (!report::in_path(report::kPlotter)) {
    throw input_error(report::kPlotter, "isn't there, and draws the plots", "install the package gnuplot-nox");
  }
  Outputs outputs(call.output, sections, call.force);
  const report::ScratchFolder scratch;
  settings.scratch = scratch.path();

  const auto start = std::chrono::steady_clock::now();
  report::Page page;
  nlohmann::json told = nlohmann::json::array();
  std::vector<std::string> contents;
  try {
    for (const ListedSection& listed : sections) {
      const auto begin = std::chrono::steady_clock::now();
      page.sections.push_back(measured(listed, settings));
      const report::PageSection& part = page.sections.back();
      report::check_interrupted(settings);
      contents.push_back(report::csv(part.section.table));
      told.push_back({{"section", part.id},
                      {"rows", part.section.table.rows.size()},
                      {"seconds", seconds_since(begin)},
                      {"failed", part.failed}});
      if (!call.json) {
        std::printf("%s: %zu rows in %.1f s\n", listed.id, part.section.table.rows.size(), seconds_since(begin));
        std::fflush(stdout);
      }
    }
  } catch (const report::Interrupted&) {
    throw runtime_failure(call.output, "interrupted; nothing was written");
  }
  add_facts(page, call, seconds_since(start));
  contents.push_back(report::html(page));
  outputs.write(contents);
  if (call.json) {
    print_json({{"output", call.output}, {"seconds", seconds_since(start)}, {"sections", told}});
  } else {
    std::printf("%s\n", (fs::path(call.output) / "index.html").c_str());
  }
  return 0;
}

}  // namespace rinkaku::app
