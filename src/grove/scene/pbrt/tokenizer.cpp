#include "grove/scene/pbrt/tokenizer.h"

#include <utility>

namespace grove::pbrt {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

bool ends_word(char c) {
  return is_space(c) || c == '"' || c == '[' || c == ']' || c == '#';
}

char unescape(char c) {
  switch (c) {
    case 'n':
      return '\n';
    case 't':
      return '\t';
    case 'r':
      return '\r';
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    default:
      return c;
  }
}

}  // namespace

Tokenizer::Tokenizer(std::shared_ptr<const std::string> file_name, std::string text)
    : file_name_(std::move(file_name)), text_(std::move(text)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
}

Token Tokenizer::next() {
  if (has_peeked_) {
    has_peeked_ = false;
    return peeked_;
  }
  return scan();
}

const Token& Tokenizer::peek() {
  if (!has_peeked_) {
    peeked_ = scan();
    has_peeked_ = true;
  }
  return peeked_;
}

void Tokenizer::skip_space_and_comments() {
  for (; at_ < text_.size(); ++at_) {
    if (text_[at_] == '#') {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      if (at_ == text_.size()) return;
    }
    if (text_[at_] == '\n') ++line_;
    if (!is_space(text_[at_])) return;
  }
}

Token Tokenizer::scan() {
  skip_space_and_comments();
  if (at_ == text_.size()) return {TokenKind::end, {}, line_};
  const std::string_view all = text_;
  const std::size_t first = at_;
  switch (all[at_]) {
    case '"':
      return scan_quoted();
    case '[':
      return {TokenKind::open_bracket, all.substr(at_++, 1), line_};
    case ']':
      return {TokenKind::close_bracket, all.substr(at_++, 1), line_};
    default:
      break;
  }
  while (at_ < all.size() && !ends_word(all[at_])) ++at_;
  return {TokenKind::word, all.substr(first, at_ - first), line_};
}

Token Tokenizer::scan_quoted() {
  const std::string_view all = text_;
  const std::size_t first = at_ + 1;
  bool has_escape = false;
  for (++at_; at_ < all.size() && all[at_] != '"' && all[at_] != '\n'; ++at_) {
    if (all[at_] != '\\') continue;
    has_escape = true;
    if (at_ + 1 < all.size() && all[at_ + 1] != '\n') ++at_;
  }
  if (at_ >= all.size() || all[at_] != '"') Place{file_name_, line_}.fail("a quoted string is not closed on its line; add the missing \"");
  std::string_view content = all.substr(first, at_ - first);
  ++at_;
  if (!has_escape) return {TokenKind::quoted, content, line_};
  std::string& plain = unescaped_.emplace_back();
  for (std::size_t i = 0; i < content.size(); ++i) {
    const bool escaped = content[i] == '\\' && i + 1 < content.size();
    if (escaped) ++i;
    plain += escaped ? unescape(content[i]) : content[i];
  }
  return {TokenKind::quoted, plain, line_};
}

}  // namespace grove::pbrt
