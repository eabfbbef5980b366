// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Small meshes with what meshes should not have.
#ifndef ANICODEC_TESTS_SDK_TRIANGLE_LISTS_H_
#define ANICODEC_TESTS_SDK_TRIANGLE_LISTS_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace anicodec {

struct TriangleList {
  std::string name;
  std::vector<uint32_t> triangles;
  uint32_t vertex_count = 0;

  void add(uint32_t a, uint32_t b, uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); }
};

/// columns x rows vertices, row by row.
inline TriangleList grid_list(uint32_t columns, uint32_t rows) {
  TriangleList list{"grid", {}, columns * rows};
  for (uint32_t y = 0; y + 1 < rows; ++y) {
    for (uint32_t x = 0; x + 1 < columns; ++x) {
      uint32_t a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
      list.add(a, b, d);
      list.add(a, d, c);
    }
  }
  return list;
}

inline std::vector<TriangleList> odd_triangle_lists() {
  auto at = [](TriangleList& list, std::ptrdiff_t corner) {
    return list.triangles.begin() + corner;
  };
  std::vector<TriangleList> lists{grid_list(9, 7)};

  TriangleList holes = grid_list(10, 10);
  holes.name = "holes";
  for (std::ptrdiff_t first : {300, 150, 156, 30})
    holes.triangles.erase(at(holes, first), at(holes, first + 6));
  lists.push_back(holes);

  TriangleList duplicates = grid_list(8, 8);
  duplicates.name = "duplicates";
  std::vector<uint32_t> again(at(duplicates, 60), at(duplicates, 120));
  duplicates.triangles.insert(duplicates.triangles.end(), again.begin(), again.end());
  duplicates.add(0, 9, 1);  // turned over
  lists.push_back(duplicates);

  // Three sheets on one spine, and a fan that touches it in a vertex.
  TriangleList book{"non-manifold", {}, 7 + 3 * 7 * 4 + 5};
  for (uint32_t page = 0; page < 3; ++page) {
    auto vertex = [&](uint32_t i, uint32_t j) {
      return j == 0 ? i : 7 + (page * 4 + j - 1) * 7 + i;
    };
    for (uint32_t j = 0; j < 4; ++j) {
      for (uint32_t i = 0; i + 1 < 7; ++i) {
        book.add(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
        book.add(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
      }
    }
  }
  for (uint32_t s = 0; s < 5; ++s)
    book.add(6, 91 + s, 91 + (s + 1) % 5);
  lists.push_back(book);

  // Two components of several pieces that share vertices only, and vertices without face.
  TriangleList touching{"touching", {}, 40};
  for (uint32_t i = 0; i < 10; ++i)
    touching.add(2 * i, 2 * i + 1, 2 * i + 2);
  for (uint32_t i = 11; i < 17; ++i)
    touching.add(2 * i, 2 * i + 2, 2 * i + 1);
  touching.add(24, 28, 32);
  lists.push_back(touching);

  TriangleList degenerate = grid_list(6, 6);
  degenerate.name = "degenerate";
  degenerate.vertex_count += 3;
  degenerate.add(3, 3, 4);
  degenerate.add(5, 5, 5);
  degenerate.add(36, 36, 36);
  degenerate.add(37, 37, 38);
  degenerate.add(7, 8, 7);
  lists.push_back(degenerate);

  TriangleList star{"star", {}, 201};
  for (uint32_t i = 0; i < 100; ++i)
    star.add(0, 1 + 2 * i, 2 + 2 * i);
  lists.push_back(star);

  TriangleList fin{"many faces on an edge", {}, 62};
  for (uint32_t i = 2; i < 62; ++i)
    fin.add(0, 1, i);
  lists.push_back(fin);

  lists.push_back({"no faces", {}, 4});
  lists.push_back({"one triangle", {0, 1, 2}, 3});
  return lists;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_SDK_TRIANGLE_LISTS_H_
