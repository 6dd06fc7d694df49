#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "hdf5_file.hpp"
#include "littoral/error.hpp"
#include "littoral/support/series.hpp"
#include "output_file.hpp"
#include "xdmf.hpp"

namespace littoral::support {

struct FieldSeries::Impl {
  std::filesystem::path folder;
  std::string name;
  std::vector<std::string> steps;  // XDMF text of each
  int next_step = 0;

  std::string file(const std::string& rest) const { return (folder / (name + rest)).string(); }
  std::string h5_name(int step) const {
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), "_%06d.h5", step);
    return name + digits.data();
  }
  std::string h5_path() const { return (folder / h5_name(next_step)).string(); }

  void continue_after(double time);
  void require_size(const std::string& what, std::size_t found, std::size_t expected) const;
  /// Data first, then the XDMF file that names them.
  void finish(Hdf5Image& image, const std::string& xdmf);
};

namespace {

std::size_t product(const std::array<int, 3>& n, int more) {
  std::size_t out = 1;
  for (const int extent : n) out *= static_cast<std::size_t>(extent + more);
  return out;
}

}  // namespace

FieldSeries::FieldSeries(const std::string& folder, const std::string& name, bool restarted,
                         double restart_time)
    : impl_(std::make_unique<Impl>()) {
  impl_->folder = folder;
  impl_->name = name;
  if (restarted) impl_->continue_after(restart_time);
  replace_file(impl_->file(".xdmf"), xdmf_file(name, impl_->steps));
}

FieldSeries::FieldSeries(FieldSeries&&) noexcept = default;
FieldSeries::~FieldSeries() = default;

void FieldSeries::Impl::continue_after(double time) {
  std::ifstream old(file(".xdmf"));
  std::ostringstream text;
  text << old.rdbuf();
  for (const auto& step : xdmf_steps(text.str())) {
    if (step.time <= time) {
      steps.push_back(step.text);
      next_step = std::max(next_step, step.step + 1);
    } else {
      std::error_code ignored;
      std::filesystem::remove(folder / h5_name(step.step), ignored);
    }
  }
}

void FieldSeries::Impl::require_size(const std::string& what, std::size_t found, std::size_t expected) const {
  if (found != expected)
    throw IoError(h5_path() + ": " + what + " has " + std::to_string(found) + " values; expected " +
                  std::to_string(expected) + ".");
}

void FieldSeries::Impl::finish(Hdf5Image& image, const std::string& xdmf) {
  ReplacingFile data(h5_path());
  std::size_t count = 0;
  const void* bytes = image.bytes(count);
  data.commit(bytes, count);
  steps.push_back(xdmf);
  ++next_step;
  replace_file(file(".xdmf"), xdmf_file(name, steps));
}

void FieldSeries::write_points(double time, const std::vector<double>& xyz,
                               const std::vector<OutputField>& point_fields) {
  const std::size_t n = xyz.size() / 3;
  impl_->require_size("xyz", xyz.size(), 3 * n);
  Hdf5Image image(impl_->h5_path());
  image.put("xyz", {n, 3}, xyz.data());
  std::vector<std::int32_t> vertices(n);
  std::iota(vertices.begin(), vertices.end(), 0);
  image.put("vertices", {n, 1}, vertices.data());
  for (const auto& field : point_fields) {
    const auto components = static_cast<std::size_t>(field.components);
    impl_->require_size("field '" + field.name + "'", field.values.size(), components * n);
    image.put(field.name, components == 1 ? std::vector<hsize_t>{n} : std::vector<hsize_t>{n, components},
              field.values.data());
  }
  impl_->finish(image,
                xdmf_points(impl_->next_step, time, impl_->h5_name(impl_->next_step), n, point_fields));
}

void FieldSeries::write_blocks(double time, const std::vector<Block>& blocks) {
  Hdf5Image image(impl_->h5_path());
  for (const auto& block : blocks) {
    const auto shape = [&](int more, std::size_t components) {
      std::vector<hsize_t> out;
      for (const std::size_t d : {2U, 1U, 0U}) out.push_back(static_cast<hsize_t>(block.cells[d] + more));
      if (components > 1) out.push_back(components);
      return out;
    };
    impl_->require_size("nodes of block '" + block.name + "'", block.nodes.size(),
                        3 * product(block.cells, 1));
    image.put(block.name + "/nodes", shape(1, 3), block.nodes.data());
    for (const auto& field : block.cell_fields) {
      const auto components = static_cast<std::size_t>(field.components);
      impl_->require_size("field '" + field.name + "' of block '" + block.name + "'", field.values.size(),
                          components * product(block.cells, 0));
      image.put(block.name + "/" + field.name, shape(0, components), field.values.data());
    }
  }
  impl_->finish(image, xdmf_blocks(impl_->next_step, time, impl_->h5_name(impl_->next_step), blocks));
}

}  // namespace littoral::support
