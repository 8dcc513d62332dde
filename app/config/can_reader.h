#pragma once
// [can] of a rig file: which bus, which messages how often, and that they fit onto it.

#include <toml++/toml.h>

#include "app/config/table_reader.h"
#include "app/config/unit_config.h"

namespace dottrack::config {

// What `can` has is the default. A key without effect, such as data_bit_rate of a bus that is not
// fd, is a complaint.
void read_can(Complaint& complaint, const toml::table& table, CanConfig& can);

}  // namespace dottrack::config
