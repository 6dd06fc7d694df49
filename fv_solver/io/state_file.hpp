#pragma once

#include <optional>
#include <string>
#include <vector>

#include "littoral/support/checkpoint.hpp"
#include "parallel/whole.hpp"

namespace littoral::fv {

/// A checkpoint in the making: fields are those of whole blocks, gathered from all ranks, so that a run may
/// go on with any number of them. The root writes. comm collective, all but the destructor. throws IoError
template <int D>
class StateWriter {
 public:
  StateWriter(const std::string& path, const Layout<D>& layout) : layout_(layout) {
    if (layout.owners.ranks.root()) file_.emplace(path);
  }
  const Layout<D>& layout() const { return layout_; }

  /// The same value on all ranks.
  template <class T>
  void put(const std::string& name, const T& value) {
    if (file_) file_->put(name, value);
  }
  /// "block<whole>/<name>" below `group` ("" or "path/"); own: a field for each own block, ghosts included
  void put_fields(const std::string& group, const std::string& name, const std::vector<const Field*>& own) {
    const std::vector<Field> whole = gather_whole<D>(layout_, own);
    for (std::size_t w = 0; w < whole.size(); ++w) file_->put(key(group, w, name), whole[w]);
  }
  void commit() {
    if (file_) file_->commit();
  }
  /// Where only the root can put something.
  support::CheckpointWriter* file() { return file_ ? &*file_ : nullptr; }

  static std::string key(const std::string& group, std::size_t whole, const std::string& name) {
    return group + "block" + std::to_string(whole) + "/" + name;
  }

 private:
  const Layout<D>& layout_;
  std::optional<support::CheckpointWriter> file_;
};

}  // namespace littoral::fv
