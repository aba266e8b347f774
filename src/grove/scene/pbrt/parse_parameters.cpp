#include <array>
#include <utility>

#include "grove/scene/pbrt/numbers.h"
#include "grove/scene/pbrt/parameters.h"

namespace grove::pbrt {
namespace {

struct TypeName {
  std::string_view name;
  ParameterType type;
};

// Both the spellings of version 4 and, where they differ, of version 3.
constexpr std::array<TypeName, 19> kTypeNames{{{"float", ParameterType::real},
                                               {"integer", ParameterType::integer},
                                               {"bool", ParameterType::boolean},
                                               {"string", ParameterType::string},
                                               {"texture", ParameterType::texture},
                                               {"rgb", ParameterType::rgb},
                                               {"color", ParameterType::rgb},
                                               {"spectrum", ParameterType::spectrum},
                                               {"blackbody", ParameterType::blackbody},
                                               {"point2", ParameterType::point2},
                                               {"point3", ParameterType::point3},
                                               {"point", ParameterType::point3},
                                               {"vector2", ParameterType::vector2},
                                               {"vector3", ParameterType::vector3},
                                               {"vector", ParameterType::vector3},
                                               {"normal", ParameterType::normal},
                                               {"normal3", ParameterType::normal},
                                               {"point4", ParameterType::real},
                                               {"vector4", ParameterType::real}}};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Splits "type name" at its blanks. Throws unless there are two words and the first is a type.
Parameter parse_declaration(std::string_view text, const Place& place) {
  std::array<std::string_view, 2> words;
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !is_blank(text[end])) ++end;
    if (count < 2) words[count] = text.substr(at, end - at);
    ++count;
    at = end;
  }
  if (count != 2) place.fail("expected a parameter such as \"float radius\", found \"" + std::string(text.substr(0, 60)) + "\"");
  for (const TypeName& known : kTypeNames) {
    if (known.name != words[0]) continue;
    Parameter parameter;
    parameter.type = known.type;
    parameter.name = std::string(words[1]);
    parameter.place = place;
    return parameter;
  }
  place.fail("unknown parameter type \"" + std::string(words[0].substr(0, 60)) + "\" of \"" + std::string(words[1].substr(0, 60)) +
             "\"; known are float integer bool string texture rgb spectrum blackbody point2 point3 vector2 vector3 normal");
}

void add_flag(Parameter& parameter, const Token& token) {
  if (token.text != "true" && token.text != "false")
    parameter.place.fail("\"" + parameter.name + "\" takes true or false, not \"" + std::string(token.text.substr(0, 60)) + "\"");
  parameter.flags.push_back(token.text == "true");
}

void add_number(Parameter& parameter, const Token& token) {
  if (parameter.type == ParameterType::integer) {
    const auto value = parse_integer(token.text);
    if (!value)
      parameter.place.fail("\"" + parameter.name + "\" takes 32-bit integers, not \"" + std::string(token.text.substr(0, 60)) + "\"");
    parameter.integers.push_back(*value);
    return;
  }
  const auto value = parse_float(token.text);
  if (!value) parameter.place.fail("\"" + parameter.name + "\" takes numbers, not \"" + std::string(token.text.substr(0, 60)) + "\"");
  parameter.numbers.push_back(*value);
}

void add_value(Parameter& parameter, const Token& token) {
  const bool quoted = token.kind == TokenKind::quoted;
  switch (parameter.type) {
    case ParameterType::boolean:
      add_flag(parameter, token);
      return;
    case ParameterType::string:
    case ParameterType::texture:
      if (!quoted) parameter.place.fail("\"" + parameter.name + "\" takes quoted strings, not " + std::string(token.text.substr(0, 60)));
      parameter.strings.emplace_back(token.text);
      return;
    case ParameterType::spectrum:
      if (quoted) {
        parameter.strings.emplace_back(token.text);
        return;
      }
      break;
    default:
      if (quoted) parameter.place.fail("\"" + parameter.name + "\" takes numbers, not \"" + std::string(token.text.substr(0, 60)) + "\"");
  }
  add_number(parameter, token);
}

void check_count(const Parameter& parameter) {
  std::size_t group = 1;
  switch (parameter.type) {
    case ParameterType::point2:
    case ParameterType::vector2:
      group = 2;
      break;
    case ParameterType::point3:
    case ParameterType::vector3:
    case ParameterType::normal:
    case ParameterType::rgb:
      group = 3;
      break;
    case ParameterType::spectrum:
      if (parameter.strings.empty()) group = 2;
      break;
    default:
      break;
  }
  const std::size_t count = parameter.numbers.size() + parameter.integers.size() + parameter.flags.size() + parameter.strings.size();
  if (count == 0) parameter.place.fail("\"" + parameter.name + "\" has no value");
  if (count % group != 0)
    parameter.place.fail("\"" + parameter.name + "\" has " + std::to_string(count) + " values, which is not a multiple of " +
                         std::to_string(group));
}

}  // namespace

ParameterList parse_parameters(Tokenizer& tokens, const Place& directive) {
  ParameterList list(directive);
  while (tokens.peek().kind == TokenKind::quoted) {
    const Token declaration = tokens.next();
    Parameter parameter = parse_declaration(declaration.text, tokens.place(declaration));
    Token value = tokens.next();
    if (value.kind == TokenKind::open_bracket) {
      for (value = tokens.next(); value.kind != TokenKind::close_bracket; value = tokens.next()) {
        if (value.kind == TokenKind::end || value.kind == TokenKind::open_bracket)
          parameter.place.fail("the values of \"" + parameter.name + "\" are not closed with ]");
        add_value(parameter, value);
      }
    } else if (value.kind == TokenKind::word || value.kind == TokenKind::quoted) {
      add_value(parameter, value);
    }
    check_count(parameter);
    parameter.numbers.shrink_to_fit();
    parameter.integers.shrink_to_fit();
    list.add(std::move(parameter));
  }
  return list;
}

}  // namespace grove::pbrt
