// The mesh files that are read, one function a type, from the file's bytes.
//
// Everything that is read of them is checked: each number is finite, each index names something that is there, nothing
// is missing or left over. Errors: kMalformed, of text with the line, of binary data with the element; kUnsupported for
// what is valid and not provided.
#pragma once

#include <string_view>

#include "burnish/mesh/files/polygon_mesh.h"

namespace burnish {

// Wavefront OBJ (Alias|Wavefront, "Object Files", appendix B1): v, vt, vn and f. Groups, materials, lines and points
// are passed over; free-form curves and surfaces are refused.
PolygonMesh read_obj(std::string_view bytes, const std::string& name);

// PLY 1.0 (Turk, "The PLY Polygon File Format", 1994), ASCII and binary of both byte orders. Of element vertex: x, y,
// z; nx, ny, nz; one of s, t / u, v / texture_u, texture_v. Of element face: vertex_indices or vertex_index, and
// texcoord (two for each corner), which goes before the vertices' own. The rest is passed over.
PolygonMesh read_ply(std::string_view bytes, const std::string& name);

// OFF as text (Geomview, "OOGL File Formats"), with normals (N), colours (C, passed over) and texture coordinates (ST);
// a vertex and a face a line. Refuses binary files and those of four or more dimensions. Faces of one or two corners
// are valid and have no area.
PolygonMesh read_off(std::string_view bytes, const std::string& name);

// STL (3D Systems, "StereoLithography Interface Specification", 1989), ASCII and binary. Equal positions become one;
// the facets' normals say nothing that their corners do not, and are passed over.
PolygonMesh read_stl(std::string_view bytes, const std::string& name);

}  // namespace burnish
