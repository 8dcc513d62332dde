#pragma once
// Who may know whom, and what the tracker's core must not contain.

#include <string>
#include <vector>

#include "tests/unit/architecture/source_files.h"

namespace dottrack::architecture {

// Each violation is one line: `path:line: what`.
using Violations = std::vector<std::string>;

// Includes that point against the allowed directions; a folder that has no rule is a violation too.
Violations forbidden_includes(const SourceFile& file);

// In app/core: clocks, threads, files, streams and the heap.
Violations impurities(const SourceFile& file);

}  // namespace dottrack::architecture
