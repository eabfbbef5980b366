// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/mtl.h"

#include "tools/io/base/printable.h"
#include "tools/io/base/shininess.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/base/text_output.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace anicodec::tools {
namespace {

/// Statements that name an image.
struct ImageStatement {
  std::string_view keyword;
  TextureSlot slot;
};

constexpr ImageStatement kImages[] = {{"map_Kd", TextureSlot::kBaseColour},
                                      {"map_Ke", TextureSlot::kEmissive},
                                      {"map_Pr", TextureSlot::kMetallicRoughness},
                                      {"map_Pm", TextureSlot::kMetallicRoughness},
                                      {"norm", TextureSlot::kNormal},
                                      {"map_Bump", TextureSlot::kNormal},
                                      {"map_bump", TextureSlot::kNormal},
                                      {"bump", TextureSlot::kNormal}};

/// The file of an image statement, whose options come first: "-bm 0.5 -clamp on wood grain.png".
std::string_view image_path(std::string_view rest) {
  // How many words follow an option, at most; those that are no numbers end it.
  while (rest.starts_with('-')) {
    size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    const std::string_view option = rest.substr(0, end);
    size_t values = option == "-o" || option == "-s" || option == "-t" ? 3
                    : option == "-mm"                                  ? 2
                                                                       : 1;
    rest.remove_prefix(end);
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    for (bool first = true; values > 0; --values, first = false) {
      end = std::min(rest.find_first_of(" \t"), rest.size());
      const bool is_number = rest.find_first_not_of("0123456789+-.eE") >= end;
      if (!first && !is_number)
        break;
      rest.remove_prefix(end);
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    }
  }
  return rest;
}

class MtlParser {
 public:
  MtlParser(std::string_view text, std::string_view name, PolygonLabels& materials,
            LeftKinds& left_out)
      : in_(text, name, {.comment = '#', .continuation = true}),
        materials_(materials),
        left_out_(left_out),
        is_blenders_(text.starts_with("# Blender")) {
    for (size_t i = 0; i < materials.names.size(); ++i)
      numbers_.try_emplace(materials.names[i], i);
  }

  void parse() {
    while (in_.next_line()) {
      statement(in_.word("a statement"));
      in_.skip_line();
    }
    end();
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "newmtl")
      return begin();
    if (!look_)
      return;
    bool is_kept = true;
    if (keyword == "Kd")
      colour(look_->base_colour.data());
    else if (keyword == "Ke")
      colour(look_->emissive.data());
    else if (keyword == "d")
      opacity(number());
    else if (keyword == "Tr")
      opacity(1 - number());
    else if (keyword == "Pr")
      look_->roughness = number(), has_roughness_ = true;
    else if (keyword == "Pm")
      look_->metallic = number(), has_metallic_ = true;
    else if (keyword == "Ka")
      colour(ambient_), is_kept = is_blenders_;
    else if (keyword == "illum")
      reflects_ = number() == 3;
    else if (keyword == "Ns")
      look_->roughness = has_roughness_ ? look_->roughness : roughness_of_shininess(number());
    else
      is_kept = false;
    for (const ImageStatement& image : kImages) {
      if (keyword == image.keyword) {
        look_->texture(image.slot) = image_path(in_.rest_of_line());
        is_kept = true;
      }
    }
    if (!is_kept)
      left_out_.add("'" + shown(keyword) + "' of materials");
  }

  /// Blender writes how metallic a material is as the ambient colour of one that reflects.
  void end() {
    if (look_ && is_blenders_ && reflects_ && !has_metallic_)
      look_->metallic = std::min((ambient_[0] + ambient_[1] + ambient_[2]) / 3, 1.0F);
  }

  void begin() {
    end();
    const auto found = numbers_.find(std::string(in_.rest_of_line()));
    look_ = nullptr;
    has_roughness_ = has_metallic_ = reflects_ = false;
    ambient_[0] = ambient_[1] = ambient_[2] = 0;
    if (found == numbers_.end())
      return;
    materials_.looks.resize(materials_.names.size());
    look_ = &materials_.looks[found->second];
    *look_ = {};
    look_->known = true;
  }

  float number() {
    const double x = in_.number("number");
    if (!std::isfinite(x))
      in_.fail("a number that is not finite");
    return static_cast<float>(std::clamp(x, 0.0, 1e30));
  }

  /// Three numbers, or one for all; a spectrum or CIE values are left.
  void colour(float* to) {
    const std::string_view rest = TextCursor(in_).rest_of_line();
    if (rest.starts_with("spectral") || rest.starts_with("xyz"))
      return;
    to[0] = to[1] = to[2] = number();
    for (int i = 1; i < 3 && !in_.at_line_end(); ++i)
      to[i] = number();
  }

  void opacity(float alpha) {
    look_->base_colour[3] = std::clamp(alpha, 0.0F, 1.0F);
    look_->alpha = alpha < 1 ? AlphaMode::kBlend : AlphaMode::kOpaque;
  }

  TextCursor in_;
  PolygonLabels& materials_;
  LeftKinds& left_out_;
  std::map<std::string, size_t> numbers_;
  /// The material that is described; null: none of those asked for.
  MaterialLook* look_ = nullptr;
  bool has_roughness_ = false;  ///< told by itself, not only by the exponent
  bool has_metallic_ = false, reflects_ = false;
  float ambient_[3] = {};
  bool is_blenders_;
};

void append_line(std::string_view keyword, std::span<const float> numbers, std::string& out) {
  out += keyword;
  out += ' ';
  append_floats(numbers, out);
  out += '\n';
}

}  // namespace

void parse_mtl(std::string_view text, std::string_view name, PolygonLabels& materials,
               LeftKinds& left_out) {
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3);
  MtlParser(text, name, materials, left_out).parse();
}

bool has_looks(const PolygonLabels& materials) {
  return std::ranges::any_of(materials.looks, &MaterialLook::known);
}

void append_mtl(const PolygonLabels& materials, std::string& out) {
  for (size_t i = 0; i < materials.looks.size(); ++i) {
    const MaterialLook& look = materials.looks[i];
    if (!look.known)
      continue;
    out += "newmtl " + statement_name(materials.names[i]) + "\n";
    append_line("Kd", {look.base_colour.data(), 3}, out);
    append_line("d", {&look.base_colour[3], 1}, out);
    append_line("Ke", look.emissive, out);
    const float shininess = shininess_of_roughness(look.roughness);
    append_line("Ns", {&shininess, 1}, out);
    append_line("Pr", {&look.roughness, 1}, out);
    append_line("Pm", {&look.metallic, 1}, out);
    if (look.metallic > 0) {  // as Blender has it, which reads no Pm before version 3.6
      const float ambient[] = {look.metallic, look.metallic, look.metallic};
      append_line("Ka", ambient, out);
      out += "illum 3\n";
    }
    TextureSlot before = TextureSlot::kOcclusion;  // has no statement
    for (const ImageStatement& image : kImages) {
      const String& texture = look.texture(image.slot);
      if (image.slot == before || texture.empty() || texture[0] == '#')
        continue;
      before = image.slot;
      out += std::string(image.keyword) + " " + printable({texture.data(), texture.size()}) + "\n";
    }
  }
}

std::string statement_name(const std::string& label) {
  std::string name = printable(label);
  // One joins lines, the other begins a comment.
  std::ranges::replace_if(
      name, [](char c) { return c == '\\' || c == '#'; }, '_');
  return name;
}

}  // namespace anicodec::tools
