#include "binder_impl.hpp"

namespace littoral::support {

void Binder::Impl::write(const std::string& line) {
  std::string margin(static_cast<std::size_t>(indent), ' ');
  if (at_dash) margin.replace(margin.size() - 2, 2, "- ");
  at_dash = false;
  lines.push_back(margin + line);
}

void Binder::Impl::write_key(const std::string& name, const std::string& value, const std::string& comment) {
  std::string line = name + ":" + (value.empty() ? "" : " " + value);
  if (!comment.empty()) {
    constexpr std::size_t k_column = 28;  // comments of short lines stand below each other
    const std::size_t width = line.size() + static_cast<std::size_t>(indent);
    line += std::string(width < k_column ? k_column - width : 2, ' ') + "# " + comment;
  }
  write(line);
}

std::string Binder::text() const {
  std::string out;
  for (const auto& line : impl_->lines) out += line + "\n";
  return out;
}

}  // namespace littoral::support
