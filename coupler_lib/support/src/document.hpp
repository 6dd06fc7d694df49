#pragma once

#include <string>
#include <vector>

#include "littoral/support/config.hpp"
#include "value.hpp"

namespace littoral::support {

struct Document::Impl {
  std::string name;
  Value root;
  std::vector<Problem> problems;  // found while parsing: keys given twice
  int n_settings = 0;
};

}  // namespace littoral::support
