#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

#include "grove/scene/pbrt/place.h"

namespace grove::pbrt {

enum class TokenKind : std::uint8_t { word, quoted, open_bracket, close_bracket, end };

/// `text` is what stands there, without quotes; it lives as long as the tokenizer.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;
  std::uint32_t line = 0;
};

/// Cuts the text of one scene file into tokens: words (directives, numbers, true and false), quoted strings and brackets.
/// A # starts a comment that ends with the line.
class Tokenizer {
 public:
  Tokenizer(std::shared_ptr<const std::string> file_name, std::string text);
  Tokenizer(const Tokenizer&) = delete;  // tokens point into it
  Tokenizer& operator=(const Tokenizer&) = delete;

  /// Takes the next token; `end` again and again after the last. Throws InputError for a string that does not end on its line.
  Token next();
  /// The token that `next` would give.
  const Token& peek();

  [[nodiscard]] Place place(const Token& token) const { return {file_name_, token.line}; }
  [[nodiscard]] const std::shared_ptr<const std::string>& file_name() const { return file_name_; }

 private:
  Token scan();
  Token scan_quoted();
  void skip_space_and_comments();

  std::shared_ptr<const std::string> file_name_;
  std::string text_;
  std::deque<std::string> unescaped_;  // strings with a backslash, which cannot point into text_
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  Token peeked_;
  bool has_peeked_ = false;
};

}  // namespace grove::pbrt
