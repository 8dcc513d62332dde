#pragma once
// What a long command does at the moment: one line on a terminal, nothing where standard error is a
// file. Ctrl-C ends such a command cleanly.

#include <string>

#include "app/workstation/interrupt.h"

namespace dottrack::workstation {

class StatusLine {
 public:
  StatusLine();

  // False: the command is to be ended.
  bool show(const std::string& what) const;
  void clear() const;

 private:
  Interrupt interrupt_;
  bool on_terminal_;
};

}  // namespace dottrack::workstation
