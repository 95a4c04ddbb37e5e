// A vector of three components: normals, directions, colours.
#pragma once

#include <cmath>

#include "burnish/core/portable_math.h"

namespace burnish {

template <typename T>
struct Vec3 {
  T x{}, y{}, z{};

  template <typename U>
  explicit operator Vec3<U>() const {
    return {U(x), U(y), U(z)};
  }
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(T s, Vec3 a) { return a * s; }
  friend Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }  // per component
  friend Vec3 operator/(Vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  Vec3& operator-=(Vec3 b) { return *this = *this - b; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <typename T>
T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
T length(Vec3<T> a) {
  return std::sqrt(dot(a, a));
}
// Undefined for the zero vector.
template <typename T>
Vec3<T> normalized(Vec3<T> a) {
  return a / length(a);
}

// Angle between two vectors of any length, in radians; exact near 0 and near π, where acos of the dot product is not.
inline double angle_rad(Vec3d a, Vec3d b) { return portable::atan2(length(cross(a, b)), dot(a, b)); }

inline constexpr double kPi = 3.14159265358979323846;
inline double degrees(double rad) { return rad * (180.0 / kPi); }
inline double radians(double deg) { return deg * (kPi / 180.0); }

}  // namespace burnish
