#pragma once

#include <ostream>
#include <streambuf>

namespace trammel::harness {

/// As long as it lives, control characters other than line breaks and tabs reach the stream as '?',
/// so that no text of a case commands the terminal.
class PrintableStream : std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}
  ~PrintableStream() override { stream_.rdbuf(target_); }
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  int overflow(int c) override {
    if (c == traits_type::eof()) return traits_type::not_eof(c);
    const bool control = (c >= 0 && c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    return target_->sputc(control ? '?' : static_cast<char>(c));
  }
  int sync() override { return target_->pubsync(); }

  std::ostream& stream_;
  std::streambuf* target_;
};

}  // namespace trammel::harness
