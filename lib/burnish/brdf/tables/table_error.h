// How far a table, looked up bilinearly, is from its function.
#pragma once

#include "burnish/brdf/tables/lookup_table.h"
#include "burnish/core/file_type.h"
#include "burnish/core/progress.h"

namespace burnish {

struct TableErrors {
  double max_abs = 0, rms = 0;  // over the whole domain, ends included, and all channels
  double wrap = 0;              // offset half: largest where a repeat filter mixes the two ends; else 0
};

// Asked at 64 steps from texel to texel, at 8 in each direction where there are two, and at 4 beyond 2²⁰ texels: there
// is one where a root's end errs most, a quarter of the way. In parallel, summed in a fixed order.
TableErrors table_errors(const LookupFunction& function, const LookupTable& table, const Progress& progress = {});

// The largest value, which integer files divide by (FORMATS: burnish:scale); 1 where all are 0.
double table_scale(const LookupTable& table);

// kUnsupported where values are beyond what the samples hold: 65504 for half, single precision for all.
void require_can_hold(SampleType sample, const LookupTable& table);

// What a file of such samples gives back of the texels; integers hold value / scale. kUnsupported as above.
LookupTable as_stored(const LookupTable& table, SampleType sample);

// The smallest table, with sides that are powers of two, whose error as stored is at most `max_error`: of two
// dimensions the fewest texels, then the squarest, then the wider. Where offset half mixes the two ends every size errs
// alike; that (TableErrors::wrap) is not judged. kUsage where `max_error` is not above 0 or none of 2²² texels is good
// enough; kUnsupported as above.
LookupTable smallest_table(const LookupFunction& function, TableSampling sampling, TableLayout layout,
                           SampleType sample, double max_error, const Progress& progress = {});

}  // namespace burnish
