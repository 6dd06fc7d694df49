#include "boundary/closed_body.hpp"

#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

bool keeps_the_water(Condition condition) {
  switch (condition) {
    case Condition::wall:
    case Condition::slip:
    case Condition::symmetry:
    case Condition::inflow:
    case Condition::periodic:
    case Condition::join:
    case Condition::overset:
      return true;
    default:
      return false;
  }
}

}  // namespace

template <int D>
bool closed_body(const std::vector<Block<D>>& blocks) {
  for (const Block<D>& block : blocks) {
    for (const Window<D>& window : block.windows)
      if (!keeps_the_water(window.condition)) return false;
    const Extent<D>& e = block.extent;
    bool given = false;
    for_each_index<D>({}, e.n, [&](const std::array<int, D>& index) {
      const CellStatus status = block.status[static_cast<std::size_t>(e.at(index))];
      given = given || status == CellStatus::fringe || status == CellStatus::forced;
    });
    if (given) return false;
  }
  return true;
}

template bool closed_body<2>(const std::vector<Block<2>>&);
template bool closed_body<3>(const std::vector<Block<3>>&);

}  // namespace littoral::fv
