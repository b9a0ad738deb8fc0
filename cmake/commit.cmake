# Run by each build: writes the commit into OUT, which is left as it is where it says so already.
execute_process(COMMAND git -C ${ROOT} describe --always "--dirty= with changes" --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
set(text "namespace gonio {\nextern const char* const commit;\nconst char* const commit = \"${commit}\";\n}\n")
set(before)
if(EXISTS ${OUT})
  file(READ ${OUT} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${OUT} "${text}")
endif()
