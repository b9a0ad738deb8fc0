// The function that a page's worker calls: a request in JSON (fitting/ask/page_request.h) about
// files that the worker holds in memory.  The answer is a document, or the line that the program
// would end with.
#include <new>

#include "base/error.h"
#include "exports.h"
#include "fitting/ask/page_request.h"

__attribute__((import_module("page"), import_name("phase"))) extern "C" void page_phase(
    const char* what);

/// The program's exit code.
GONIO_EXPORT(ask) int page_ask(const char* request) {
  try {
    answer = gonio::answer_page(request, [](const std::string& what) { page_phase(what.c_str()); });
    return 0;
  } catch (const gonio::Error& e) {
    answer = e.what();
    return static_cast<int>(e.code());
  } catch (const std::bad_alloc&) {
    answer = "the browser gives this page no more memory";
    return 3;
  } catch (const std::exception& e) {
    answer = e.what();
    return 3;
  }
}
