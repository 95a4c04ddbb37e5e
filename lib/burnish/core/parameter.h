// A parameter of a surface: one number for all texels, or a map of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "burnish/core/file_ref.h"
#include "burnish/core/shared_size.h"

namespace burnish {

// How it is given. Of a map the first channel counts: integers as [0,1], floats as they are, and true values are
// stored · burnish:scale + burnish:bias where the file says so.
struct ParameterSource {
  double number = 0;
  FileRef map;  // goes before the number, where there is one
};

// Its values in some rows, or in all.
struct Parameter {
  std::string name;  // for messages: "alpha-x", or the map's
  float number = 0;
  std::vector<float> values;  // of a map, row by row; otherwise empty
  int width = 0;              // of a map
  int first_row = 0;          // of the map, in values

  float at(std::size_t texel) const { return values.empty() ? number : values[texel]; }
  // Throws where a value is not as wanted: kUsage for the number, kMalformed with column and row for a texel.
  void require(const std::function<bool(float)>& holds, const std::string& wanted) const;
};

// A parameter in bands of rows.
class ParameterReader {
 public:
  // kMalformed as SharedSize; kUsage for a number that single precision takes for 0 or infinity.
  ParameterReader(const std::string& name, const ParameterSource& source, SharedSize& size);
  ~ParameterReader();
  ParameterReader(ParameterReader&&) noexcept;

  bool is_map() const { return bool(map_); }
  // Rows [first, first + count); in any order, ascending is fast.
  Parameter rows(int first, int count);

 private:
  struct Map;
  std::string name_;
  float number_ = 0;
  std::unique_ptr<Map> map_;
};

// All of it. Errors as ParameterReader.
Parameter read_parameter(const std::string& name, const ParameterSource& source, SharedSize& size);

}  // namespace burnish
