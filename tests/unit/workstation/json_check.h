#pragma once
// Is a text JSON (RFC 8259)? And what does a member of its outermost object say?

#include <optional>
#include <string>

namespace dottrack::workstation {

bool is_json(const std::string& text);

// The text of a member's value, white space around it left out; nothing when there is no such
// member or the text is not a JSON object.
std::optional<std::string> json_member(const std::string& text, const std::string& key);

}  // namespace dottrack::workstation
