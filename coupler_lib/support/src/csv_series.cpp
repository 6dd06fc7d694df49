#include <array>
#include <filesystem>
#include <fstream>

#include "littoral/error.hpp"
#include "littoral/support/series.hpp"
#include "numbers.hpp"
#include "output_file.hpp"

namespace littoral::support {

struct CsvSeries::Impl {
  std::string path;
  std::size_t n_columns = 0;
  std::unique_ptr<OutputFile> file;
  void write(const std::string& text) {
    file->write(text);
    file->flush();
  }
};

namespace {

std::string header(const std::vector<std::string>& columns) {
  std::string line;
  for (const auto& column : columns) line += (line.empty() ? "" : ",") + column;
  return line + "\n";
}

std::string comment_line(const std::string& comment) { return comment.empty() ? "" : "# " + comment + "\n"; }

/// The time of a complete row; nothing for the torn last row of a run that died while writing.
std::optional<double> row_time(const std::string& line, std::size_t n_columns) {
  std::size_t n = 1;
  for (const char c : line) n += c == ',' ? 1 : 0;
  if (n != n_columns) return std::nullopt;
  return parse_number(line.substr(0, line.find(',')));
}

}  // namespace

CsvSeries::CsvSeries() : impl_(std::make_unique<Impl>()) {}
CsvSeries::CsvSeries(CsvSeries&&) noexcept = default;
CsvSeries::~CsvSeries() = default;

CsvSeries::CsvSeries(const std::string& path, const std::vector<std::string>& columns,
                     const std::string& units_comment)
    : CsvSeries() {
  impl_->path = path;
  impl_->n_columns = columns.size();
  impl_->file = std::make_unique<OutputFile>(path, OutputFile::Mode::create);
  impl_->write(header(columns) + comment_line(units_comment));
}

CsvSeries CsvSeries::append_after(const std::string& path, const std::vector<std::string>& columns,
                                  double time, const std::string& units_comment) {
  std::ifstream old(path);
  if (!old) return CsvSeries(path, columns, units_comment);
  std::string line;
  std::getline(old, line);
  if (line + "\n" != header(columns))
    throw IoError(path + ": cannot continue this series: its columns are '" + line +
                  "', those of this run are '" + header(columns).substr(0, header(columns).size() - 1) +
                  "'. Move the file away or write to another folder.");
  std::string kept = header(columns);
  while (std::getline(old, line)) {
    if (old.eof()) break;  // no newline: torn
    if (!line.empty() && line[0] == '#') {
      kept += line + "\n";
      continue;
    }
    const auto at = row_time(line, columns.size());
    if (at && *at <= time) kept += line + "\n";
  }
  old.close();
  replace_file(path, kept);
  CsvSeries series;
  series.impl_->path = path;
  series.impl_->n_columns = columns.size();
  series.impl_->file = std::make_unique<OutputFile>(path, OutputFile::Mode::append);
  return series;
}

void CsvSeries::row(const std::vector<double>& values) {
  if (values.size() != impl_->n_columns)
    throw IoError(impl_->path + ": a row of " + std::to_string(values.size()) + " values for " +
                  std::to_string(impl_->n_columns) + " columns.");
  std::string line;
  std::array<char, 40> text{};
  for (const double value : values) {
    std::snprintf(text.data(), text.size(), "%.17g", value);
    line += (line.empty() ? "" : ",");
    line += text.data();
  }
  impl_->write(line + "\n");
}

}  // namespace littoral::support
