// Mesh files in and out: OBJ, PLY, OFF and STL; mesh_readers.h says what is read of each.
//
// Polygons become triangles (mesh/polygon.h). What has no area is dropped; edges of more than two triangles are kept.
// Normals are normalised; one of no length becomes the triangle's own.
// Errors: kIo where the file cannot be read; kMalformed where it is damaged, holds NaN, infinity or what is beyond
// single precision, names vertices that are not there, has texture coordinates or normals of some faces only, or has no
// face with area; of text with the line. kUnsupported for an unknown extension and for what is valid and not provided:
// free-form surfaces, faces of more than 10,000 corners.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

struct MeshReadStats {
  std::size_t dropped_faces = 0;  // all of whose triangles have no area
  // Statements of an OBJ that name groups, objects or materials, which a mesh does not keep: "g", "usemtl", … in the
  // file's order, each once.
  std::vector<std::string> left_out;
};

enum class MeshFileType { kObj, kPly, kOff, kStl };
// From the extension; kUnsupported for others.
MeshFileType mesh_file_type_of(const std::string& name);

// By the file's name. Keeps texture coordinates and normals where the file has them.
Mesh read_mesh(const FileRef& file, MeshReadStats* stats = nullptr);
// The same of a file's bytes.
Mesh parse_mesh(MeshFileType type, std::string_view bytes, const std::string& name, MeshReadStats* stats = nullptr);

// As text, nine digits a number. OBJ and PLY hold everything; PLY repeats vertices on seams. OFF and STL hold positions
// only: they leave normals out, and kUnsupported where there are texture coordinates.
void write_mesh(const FileRef& file, MeshFileType type, const Mesh& mesh);

}  // namespace burnish
