// What is wrong with a mesh file, said with the line, the element or the facet.
#include <gtest/gtest.h>

#include "burnish/mesh/files/mesh_io.h"
#include "expect_error.h"
#include "mesh_samples.h"

namespace burnish {
namespace {

Mesh read(const std::string& leaf, const std::string& bytes) {
  return parse_mesh(mesh_file_type_of(leaf), bytes, leaf);
}

void refuses(const std::string& leaf, const std::string& bytes, const std::string& part,
             ErrorKind kind = ErrorKind::kMalformed) {
  EXPECT_ERROR(read(leaf, bytes), kind, part);
}

TEST(MeshMalformed, ObjFilesAreRefusedWithItsLine) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const auto bad = [&](const std::string& text, const std::string& part, ErrorKind kind = ErrorKind::kMalformed) {
    refuses("bad.obj", text, part, kind);
  };
  bad("v 0 nan 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n",
      "bad.obj': line 1: expected a finite number within single precision, got 'nan'");
  bad("v 0 1e39 0\n", "line 1: expected a finite number within single precision, got '1e39'");
  bad("v 0 -3.5e38 0\n", "got '-3.5e38'");
  bad("v 0 1e999 0\n", "'1e999'");
  bad("v 0 +-1 0\n", "'+-1'");
  bad("# two\n\nv 0 \\\n 0\n", "line 3: expected a finite number within single precision, got the end of the line");
  bad("v 0 0 0 \\\n0\nv 0 0\n", "line 3: expected a finite number within single precision");
  bad("vt inf\n", "'inf'");
  bad("v 0 0x1 0\n", "'0x1'");
  bad("v 0 0 0 red\n", "'red'");
  bad("vn 0 0 1.2.3\n", "'1.2.3'");
  bad(vertices + "f 1 2 9\n", "line 4: expected vertex 1 to 3, got 9");
  bad(vertices + "f 1 2 99999999999999999999\n", "line 4: expected a corner as v, v/vt, v//vn or v/vt/vn");
  bad(vertices + "vt 0 0\nf 1/2 2/1 3/1\n", "line 5: expected texture coordinate 1 to 1, got 2");
  bad(vertices + "f 1//1 2//1 3//1\n", "line 4: expected normal 1 to 0, got 1");
  bad(vertices + "vt 0 0\nf 1/1 2 3/1\n", "line 5: expected every corner of a face to name its texture coordinate");
  bad(vertices + "vt 0 0\nf 1/1 2/1 3/1\nf 1 2 3\n", "line 6: expected every face to name its texture coordinates");
  bad(vertices + "vn 0 0 1\nf 1 2 3\nf 1//1 2//1 3//1\n", "line 6: expected every face to name its normals or none to");
  bad(vertices + "f 1 2\n", "line 4: expected at least 3 corners of a face, got 2");
  for (const char* corner : {"x", "-4", "0", "/1", "1/2/3/4", "1x", "1.5", "1\\2"})
    bad(vertices + "f 1 2 " + corner + "\n", std::string("got '") + corner + "'");
  bad(vertices + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2/1/1/1 3/1/1/1\n", "line 6: expected a corner as v, v/vt");
  bad(vertices + "face 1 2 3\n", "line 4: expected a statement of OBJ, got 'face'");
  bad(vertices + "f 1 2 3\ncstype bezier\n", "line 5: expected polygons only, got 'cstype'", ErrorKind::kUnsupported);
  bad(vertices, "expected a mesh with faces, got none");
  bad("", "expected a mesh with faces, got none");
}

TEST(MeshMalformed, PlyFilesAreRefusedWithItsLineOrElement) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n", start = "ply\nformat ascii 1.0\n",
                    face = "element face 1\nproperty list char int vertex_indices\n", end = "end_header\n",
                    head = start + "element vertex 3\n" + xyz + face + end, data = "0 0 0\n1 0 0\n0 1 0\n";
  const auto bad = [&](const std::string& text, const std::string& part, ErrorKind kind = ErrorKind::kMalformed) {
    refuses("bad.ply", text, part, kind);
  };
  EXPECT_EQ(read("good.ply", head + data + "3 0 1 2\n").triangles.size(), 1u);
  bad("", "line 1: expected 'ply', got the end of the file");
  bad("OFF\n", "line 1: expected 'ply', got 'OFF'");
  bad("ply\nformat ascii 9.0\n", "line 2: expected version 1.0, got '9.0'");
  bad("ply\nformat text 1.0\n", "line 2: expected ascii, binary_little_endian or binary_big_endian, got 'text'");
  bad("ply\nend_header\n", "expected a format");
  bad("ply\nform\x1b[31m\n", "expected a statement of PLY's header, got 'form?[31m'");
  bad(start + "property float x\n", "line 3: expected an element before its properties");
  bad(start + "element vertex many\n", "line 3: expected the number of elements, got 'many'");
  bad(start + "element vertex -1\n", "'-1'");
  bad(start + "element vertex 1\nproperty half x\n", "line 4: expected a type of PLY, got 'half'");
  bad(start + "element vertex 1\nproperty list float int x\n", "line 4: expected an integer type");
  bad(start + "element vertex 1\n" + xyz + "property int x\n", "line 7: expected each property once, got another 'x'");
  bad(start + "element vertex 1\nelement vertex 1\n", "line 4: expected each element once");
  bad(start + "element vertex 0\nproperty float x\n" + end, "expected property 'y' of element 'vertex', got none");
  bad(start + "element vertex 0\n" + xyz + "property float nx\n" + end, "expected properties nx, ny and nz or none");
  bad(start + "element face 0\n" + end, "expected a list 'vertex_indices' of integers");
  bad(start + "element vertex 3\n" + xyz + end + data, "expected a mesh with faces, got none");
  bad(start + "element tristrips 1\n" + end, "got triangle strips", ErrorKind::kUnsupported);
  bad(start + "element vertex 18446744073709551615\n" + xyz + face + end + data + "3 0 1 2\n",
      "line 13: expected the end of the line, got '2'");
  bad(head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
      "line 11: expected a finite number within single precision, got 'nan'");
  bad(head + "0 0 0\n1 0\n", "line 11: expected a finite number within single precision, got the end of the line");
  bad(head + "0 0 0\n1 0 0 0\n", "line 11: expected the end of the line, got '0'");
  bad(head + "0 0 0\n1 0 0\n", "expected vertex 3 of 3, got the end of the file");
  bad(head + data + "3 0 1 3\n", "line 13: expected one of 3 vertices, from 0, got 3");
  bad(head + data + "3 0 1 -1\n", "got -1");
  bad(head + data + "3 0 1 2.0\n", "line 13: expected an integer, got '2.0'");
  bad(head + data + "2 0 1\n", "line 13: expected at least 3 corners, got 2");
  bad(head + data + "-3 0 1 2\n", "line 13: expected the length of a list, got -3");
  bad(head + data + "128 0 1 2\n", "line 13: expected an integer of its type, got 128");
  bad(head + data + "3 0 1 2\n3 0 1 2\n", "line 14: expected the end of the file, got '3'");
  const std::string texcoord = "property list uchar float texcoord\n",
                    textured = start + "element vertex 3\n" + xyz + face + texcoord + end + data;
  bad(textured + "3 0 1 2 4 0 0 1 0\n", "line 14: expected 6 texture coordinates, got 4");
  bad(textured + "3 0 1 2 7 0 0 1 0 1 1 1\n", "line 14: expected two texture coordinates for each corner, got 7");
  bad(textured + "3 0 1 2 6 0 0 1 0 1 nan\n", "line 14: expected a finite number within single precision, got 'nan'");
  const std::string binary = testing::sample_binary_ply(std::endian::little);
  const auto damaged = [&](std::size_t from_end, const std::string& bytes) {
    return std::string(binary).replace(binary.size() - from_end, bytes.size(), bytes);
  };
  bad(damaged(9, "\5"), "bad.ply': face 2: expected one of 5 vertices, from 0, got 5");
  bad(damaged(5, "\x7f"), "face 2: expected more values, got the end of the file");
  bad(damaged(50, std::string("\0\0\x80\x7f", 4)),
      "vertex 5: expected a finite number within single precision, got inf");
  bad(binary + "\n", "bad.ply': expected the file to end with its last element, got further bytes (1)");
}

TEST(MeshMalformed, OffFilesAreRefusedWithItsLine) {
  const std::string head = "OFF\n3 1 0\n", data = "0 0 0\n1 0 0\n0 1 0\n";
  const auto bad = [&](const std::string& text, const std::string& part, ErrorKind kind = ErrorKind::kMalformed) {
    refuses("bad.off", text, part, kind);
  };
  bad("", "line 1: expected 'OFF', got the end of the file");
  bad("POFF\n", "line 1: expected 'OFF', got 'POFF'");
  bad("OFF3 1 0\n", "line 1: expected 'OFF', got 'OFF3'");
  for (const char* keyword : {"4OFF", "nOFF", "STCN4nOFF"})
    bad(keyword + std::string("\n3\n"), "expected OFF in three dimensions", ErrorKind::kUnsupported);
  bad("OFF BINARY\n\1\2", "expected OFF as text, got a binary file", ErrorKind::kUnsupported);
  bad("OFF\n3 1\n" + data, "line 2: expected the number of edges, got the end of the line");
  bad("OFF\n4294967295 1 0\n" + data, "line 5: expected vertex 4 of 4294967295, got the end of the file");
  bad("OFF\n4 2 0\n0 0 0\n1 0", "line 4: expected 3 numbers of a vertex, got 2");
  bad(head + "0 0 0 1\n", "line 3: expected 3 numbers of a vertex, got 4");
  bad("COFF\n3 1 0\n0 0 0 1 1\n", "line 3: expected 7 numbers of a vertex, got 5");
  bad(head + "0 0 0\n1 0 inf\n", "line 4: expected a finite number within single precision, got 'inf'");
  bad(head + data + "3 0 1 3\n", "line 6: expected vertex 0 to 2, got 3");
  bad(head + data + "4 0 1 2\n", "line 6: expected the vertex of a corner, got the end of the line");
  bad(head + data + "0\n", "line 6: expected a face with corners, got none");
  bad(head + data + "3 0 1 2 red\n", "line 6: expected a finite number within single precision, got 'red'");
  bad(head + data + "3 0 1 2 1 1 1 1 1\n", "line 6: expected the end of the line");
  bad(head + data, "line 5: expected face 1 of 1, got the end of the file");
  bad(head + data + "3 0 1 2\n3 0 1 2\n", "line 7: expected the end of the file, got '3'");
}

TEST(MeshMalformed, StlFilesAreRefusedWithItsLineOrFacet) {
  const std::string loop = "outer loop\nvertex 0 0 0\nvertex 1 0 0\n",
                    facet = "facet normal 0 0 1\n" + loop + "vertex 0 1 0\nendloop\nendfacet\n";
  const auto bad = [&](const std::string& text, const std::string& part) { refuses("bad.stl", text, part); };
  EXPECT_EQ(read("two.stl", "solid\n" + facet + "endsolid\nsolid b\n" + facet + "endsolid\n").triangles.size(), 2u);
  bad("", "expected 'solid' or the 84 bytes of a binary STL's header, got 0 bytes");
  bad("solid a\nendsolid a\n", "expected a mesh with faces, got none");
  bad("solid a\n" + facet, "line 8: expected 'facet' or 'endsolid', got the end of the file");
  bad("solid a\nfacet normal 0 0 1\n" + loop + "endloop\n", "line 6: expected 'vertex', got 'endloop'");
  bad("solid a\nfacet normal 0 0 1\n" + loop + "vertex 0 1 0\nvertex 0 2 0\n",
      "line 7: expected 'endloop', got 'vertex'");
  bad("solid a\nfacet normal 0 0 1\n" + loop + "vertex 0 inf 0\n",
      "line 6: expected a finite number within single precision, got 'inf'");
  bad("solid a\nfacet normal 0 0 up\n", "line 2: expected a number, got 'up'");
  bad("solid a\n" + facet + "endsolid\nfoo\n", "line 10: expected 'solid', got 'foo'");
  const std::string binary = testing::sample_binary_stl();
  bad(binary + "x", "expected 'solid' or a binary STL of 234 bytes, by its 3 facets, got 235 bytes");
  std::string nan = binary;
  nan.replace(84 + 50 + 12, 4, "\xff\xff\xff\xff");
  bad(nan, "facet 2: expected a finite number, got NaN or infinity");
}

}  // namespace
}  // namespace burnish
