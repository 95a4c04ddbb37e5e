// Moves centres that save little into crowded cells (Patanè & Russo, "The enhanced LBG algorithm", Neural Networks
// 2001).
#pragma once

#include <vector>

#include "burnish/palette/fit/lloyd.h"

namespace burnish {

// Takes the centres that are missed least and gives each to a cell that gains most by a second, across groups too, at
// most `most` of them, while `eager`·gain exceeds the cost. Both are judged before Lloyd iterations have made the most
// of the move: gains are then underrated and costs overrated, most where cells hold many points. Says how many moved.
// Needs the state a Lloyd iteration leaves. Deterministic, whatever the threads.
int relocate(std::vector<Cells>& groups, double eager, int most);

}  // namespace burnish
