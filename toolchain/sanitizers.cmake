# DOTTRACK_SANITIZE = "" | "address,undefined" | "thread"
set(DOTTRACK_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize=")
if(DOTTRACK_SANITIZE)
  add_compile_options(-fsanitize=${DOTTRACK_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${DOTTRACK_SANITIZE})
endif()
