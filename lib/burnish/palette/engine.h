// What fits a palette; each engine's own header says how.
#pragma once

namespace burnish {

enum class Engine { kSpherical, kMedianCut, kImagequant };

}  // namespace burnish
