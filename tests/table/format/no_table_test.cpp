// Files that people take for tables are refused by their names, with what to do.
#include "table/format/no_table.h"

#include "table/complaint.h"
#include "table/format/formats.h"

namespace gonio {
namespace {

using namespace test;
using namespace std::string_literals;

struct Case {
  std::string bytes, kind, cure;
};
const Case cases[] = {
    {"{\"head\": [1, 2, 3]}\n", "found JSON", "save it as CSV"},
    {"\xef\xbb\xbf[[1, 2, 3], [4, 5, 6]]\n", "found JSON", "save it as CSV"},
    {"PK\x03\x04\x14\0\x06\0[Content_Types].xml xl/workbook.xml"s, "an Excel workbook",
     "save the sheet with the values as CSV"},
    {"PK\x03\x04\x14\0mimetypeapplication/vnd.oasis.opendocument.spreadsheet"s,
     "an OpenDocument spreadsheet", "save the sheet"},
    {"PK\x03\x04\x14\0theta.npy"s, "NumPy arrays", "numpy.savetxt"},
    {"PK\x03\x04\x14\0photo.raw"s, "another ZIP archive", "save the sheet"},
    {"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "old Excel", "save the sheet"},
    {"\x93NUMPY\x01\0v\0"s, "a NumPy array", "numpy.savetxt"},
    {"\x89HDF\r\n\x1a\n\0\0"s, "HDF5", "save it as CSV"},
    {"\x1f\x8b\x08\0\0\0\0\0"s, "a gzip archive", "unpack"},
    {"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n", "a PDF document", "copy its numbers"},
    {"<!DOCTYPE HTML>\n<html><table><tr><td>1</td></tr></table></html>", "a web page",
     "copy its numbers"},
    {"<HTML>\n1 2 3\n", "a web page", "copy its numbers"},
    {"\x89PNG\r\n\x1a\n\0\0"s, "a PNG image", "gonio stack"},
    {"\xff\xd8\xff\xe0\0\x10JFIF"s, "a JPEG image", "gonio stack"},
    {"II*\0\x08\0\0\0"s, "a TIFF image", "OpenEXR"},
    {"OPTIS - Anisotropic BSDF surface file v7.0\n0 1 2\n1 2 3\n", "a BSDF of Speos", "as CSV"},
    {"made by X\nOPTIS - Anisotropic BSDF surface file\n0 1 2\n1 2 3\n", "a BSDF of Speos",
     "as CSV"},
    {"# by X\nDataType: BRDF\n1 2 3\n", "begins with DataType:", "as CSV"},
    {R"({"schema":"gonio.fit/1","model":"lambert"})", "a document of schema gonio.fit/1",
     "gonio compare"},
    {"{\n  \"schema\": \"gonio.stack/1\"\n}", "a document of schema gonio.stack/1",
     "gonio fit_map"},
    {R"({"schema": "gonio.report.cost/1"})", "a document of schema gonio.report.cost/1",
     "expected a table"}};

TEST(NoTable, IsRefusedByItsNameWithWhatToDo) {
  const Folder folder;
  for (const auto& [bytes, kind, cure] : cases) {
    const auto path = folder.write("t", bytes);
    EXPECT_COMPLAINT(path, kind);
    EXPECT_COMPLAINT(path, cure);
  }
}

TEST(NoTable, IsNoTableThatHoldsItsWords) {
  for (const char* text :
       {"theta_i,theta_o,f\n10,20,1\n", "# made of data.json by a web page\ntheta_i,theta_o,f\n",
        "PK 3 1 2\n", "note {html}\n1,2,3\n"})
    EXPECT_NO_THROW(expect_no_foreign_format("t", text)) << text;
}

}  // namespace
}  // namespace gonio
