# Reads a JUnit file that ctest wrote. Prints one line `passed failed skipped`, then a line
# `skip REASON` for every skipped test and a line `fail NAME` for every failed one.

function unescaped(text) {
  gsub(/&lt;/, "<", text); gsub(/&gt;/, ">", text); gsub(/&quot;/, "\"", text)
  gsub(/&apos;/, "'", text); gsub(/&amp;/, "\\&", text)
  return text
}

/<testcase / {
  name = $0
  sub(/^.*<testcase name="/, "", name); sub(/".*$/, "", name)
  status = $0
  sub(/^.* status="/, "", status); sub(/".*$/, "", status)
  reason = message = ""
  reason_next = 0
}
# GoogleTest says `FILE:LINE: Skipped` and on the next line why.
reason_next && status == "notrun" && reason == "" { reason = unescaped($0); reason_next = 0 }
/: Skipped$/ { reason_next = 1 }
/<skipped message="/ {
  message = $0
  sub(/^.*message="/, "", message); sub(/".*$/, "", message)
}
/<\/testcase>/ {
  if (status == "run") {
    ++passed
  } else if (status == "notrun" || status == "disabled") {
    ++skipped
    lines[++count] = "skip " (reason != "" ? reason : unescaped(name) " is " status " " message)
  } else {
    ++failed
    lines[++count] = "fail " unescaped(name)
  }
}
END {
  print passed + 0, failed + 0, skipped + 0
  for (i = 1; i <= count; ++i) print lines[i]
}
