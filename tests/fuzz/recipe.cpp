// Recipes in TOML, without the directory that they are for.
#include "burnish/batch/recipe.h"

#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_recipe(file); }

const fuzz::Target target("recipe", "recipe.toml", read);

}  // namespace
