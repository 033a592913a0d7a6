//# header colormath.h
// Colours as numbers. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Utility/libcolormath (remapColor.c).

//# adapter remapColor888to565
//#   for: int remapColor888to565(int c)
//#   kind: oneToOne
//#   fidelity: exact: the upper 5, 6 and 5 bits of red, green and blue
//#   stack: 0
inline int32_t remapColor888to565(int32_t c) {
  return (c >> 8 & 0xF800L) | (c >> 5 & 0x07E0L) | (c >> 3 & 0x001FL);
}
