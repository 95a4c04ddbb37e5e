// Mesh files in and out: OBJ, PLY, OFF and STL. With mesh decimation the only user of OpenMesh.
//
// Polygons become triangles: convex ones fans from their first corner, others by cutting off ears. Faces that name a
// vertex twice have no area and are dropped and counted; faces on an edge that two others share already are kept, on
// vertices of their own. Normals are normalised; one of no length becomes the triangle's own.
// Errors: kIo where the file cannot be read; kMalformed where it is damaged, empty, holds NaN or infinity, names
// vertices that are not there, or gives texture coordinates or normals to some corners only (of OBJ with the line);
// kUnsupported for an unknown extension.
#pragma once

#include "burnish/core/image_io.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

struct MeshReadStats {
  std::size_t dropped_faces = 0;  // without area
};

// By the file's name. Keeps texture coordinates and normals where the file has them.
Mesh read_mesh(const FileRef& file, MeshReadStats* stats = nullptr);

enum class MeshFileType { kObj, kPly, kOff, kStl };
// From the extension; kUnsupported for others.
MeshFileType mesh_file_type_of(const std::string& name);
// OBJ holds everything, nine digits a number. kUnsupported where the type cannot hold what the mesh has: only OBJ takes
// texture coordinates and normals for each corner.
void write_mesh(const FileRef& file, MeshFileType type, const Mesh& mesh);

}  // namespace burnish
