#pragma once
/// \file
/// Numbers as pages set them.

#include <cstddef>
#include <string>
#include <string_view>

namespace gonio::page {

/// To so many digits, as pages set it: "0.0312", "1 230", "4.1·10⁻⁶"; of what is not known "–".
std::string significant(double, int digits = 3);
/// The shortest text of a number within so many digits: "15", "0.04".
std::string plain(double, int digits = 6);
/// "12 345"
std::string count_text(std::size_t);
/// "2 points", "1 point"
std::string many(std::size_t, std::string_view thing);
/// "4.2 %": of a share, and with its sign "+4.2 %".  Below 1 it is never "100 %".
std::string percent(double share, int digits = 2);
std::string signed_percent(double share);
/// "3.2 ×"
std::string times(double);
/// ln of a ratio as people say it: "×1.05", "÷1.05" where it is below one.
std::string ratio_text(double ln);
/// The typical factor of a log RMS: "×/÷ 1.83".
std::string factor_text(double log_rms);
/// "12.3 ms", "1.23 s"
std::string milliseconds_text(double ms);
/// To the digit that the second of its error stands at.
std::string with_error(double, double error);
/// A name's words: "log rms" of log_rms.
std::string words(std::string_view name);
/// "55.3°"
std::string degrees_text(double, int decimals = 1);

}  // namespace gonio::page
