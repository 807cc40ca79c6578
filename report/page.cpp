#include "report/page.h"

#include "embedded/page.css.h"

namespace rinkaku::report {
namespace {

std::string cell_html(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return "<td class=\"text\">" + escaped(*text) + "</td>";
  if (const auto* number = std::get_if<double>(&cell)) return "<td>" + readable(*number) + "</td>";
  return "<td></td>";
}

std::string table_html(const Table& table) {
  std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const Column& column : table.columns) out += "<th>" + escaped(column.heading) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const Cell& cell : row) out += cell_html(cell);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string section_html(const PageSection& part) {
  std::string out = "<section id=\"" + escaped(part.id) + "\">\n<h2>" + escaped(part.title) + "</h2>\n";
  if (!part.failed.empty()) {
    return out + "<p class=\"failed\">Not measured: " + escaped(part.failed) + "</p>\n</section>\n";
  }
  out += "<p>" + escaped(part.section.intro) + "</p>\n";
  for (std::size_t i = 0; i < part.svgs.size(); ++i) {
    const Plot& plot = part.section.plots[i];
    out += "<figure>\n<h3>" + escaped(plot.title) + "</h3>\n<div class=\"wide\">" + part.svgs[i] +
           "</div>\n<figcaption>" + escaped(plot.says) + "</figcaption>\n</figure>\n";
  }
  // A long table would push the next section off a phone; it is in the CSV file in any case.
  constexpr std::size_t longest = 24;
  const std::size_t rows = part.section.table.rows.size();
  if (rows > longest) out += "<details><summary>Table of " + std::to_string(rows) + " rows</summary>\n";
  out += table_html(part.section.table);
  if (rows > longest) out += "</details>\n";
  if (part.section.repetitions == 1) out += "<p class=\"note\">Each time was taken once.</p>\n";
  if (part.section.repetitions > 1) {
    out += "<p class=\"note\">Times are medians of " + std::to_string(part.section.repetitions) +
           " repetitions; low and high, where given, are their quartiles.</p>\n";
  }
  for (const std::string& note : part.section.notes) out += "<p class=\"note\">" + escaped(note) + "</p>\n";
  return out + "<p><a href=\"" + escaped(part.id) + ".csv\">" + escaped(part.id) + ".csv</a></p>\n</section>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string html(const Page& page) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>rinkaku: error against run time</title>\n<style>\n";
  out += embedded::page_css;
  out += "</style>\n</head>\n<body>\n<h1>rinkaku: error against run time</h1>\n";
  for (const std::string& sentence : page.summary) out += "<p>" + escaped(sentence) + "</p>\n";
  out += "<nav><ul>\n";
  for (const PageSection& part : page.sections) {
    out += "<li><a href=\"#" + escaped(part.id) + "\">" + escaped(part.title) + "</a></li>\n";
  }
  out += "</ul></nav>\n<dl>\n";
  for (const auto& [name, value] : page.facts) {
    out += "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
  }
  out += "</dl>\n";
  for (const PageSection& part : page.sections) out += section_html(part);
  return out + "</body>\n</html>\n";
}

}  // namespace rinkaku::report
