// A direction map turned as its rows are read, whatever its size.
#pragma once

#include <optional>
#include <string>

#include "burnish/core/spill_file.h"
#include "burnish/material/directions/direction_map.h"
#include "burnish/material/directions/direction_turns.h"

namespace burnish {

class TurnedDirections {
 public:
  // Where rows come in another order than the file has them, all its samples go to a temporary file first
  // (spill_file.h, in `directory`): 4 bytes a texel and channel. Errors as DirectionReader, then those of its rows.
  TurnedDirections(const FileRef& file, const DirectionCoding& coding, const DirectionTurns& turns,
                   const std::string& directory);

  int width() const { return on_its_side() ? reader_.height() : reader_.width(); }
  int height() const { return on_its_side() ? reader_.width() : reader_.height(); }
  const std::string& name() const { return reader_.name(); }

  // Rows [first, first + count) of turned() of the whole map. Errors as DirectionReader::rows().
  DirectionMap rows(int first, int count);

 private:
  bool on_its_side() const { return turns_.quarters % 2 == 1; }
  // Whether the first rows are made of the last rows, or columns, of the file.
  bool backwards() const;
  void spill();
  Image spilled(int x, int y, int width, int height) const;

  DirectionReader reader_;
  DirectionTurns turns_;  // quarters: 0 to 3
  std::string directory_;
  // Strips of columns one after the other, so that a few columns lie close together.
  std::optional<SpillFile> strips_;
  int strip_width_ = 0, channels_ = 0;
};

}  // namespace burnish
