#pragma once
// what the sensors say
inline int32_t distance() {
  // TODO: complete method
  return 0;
} // in cm
inline int32_t level(void) {
  // TODO: complete method
  return 0;
}
