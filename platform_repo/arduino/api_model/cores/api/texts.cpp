// Texts and streams are those of the stand-in core of the RP2040, which rest on the API alone.
#include "../../../stand_ins/hardware/rp2040/rp2040/cores/rp2040/Print.cpp"
#include "../../../stand_ins/hardware/rp2040/rp2040/cores/rp2040/Stream.cpp"
#include "../../../stand_ins/hardware/rp2040/rp2040/cores/rp2040/WString.cpp"
#include "../../../stand_ins/hardware/rp2040/rp2040/cores/rp2040/conversions.cpp"

extern "C" char *itoa(int value, char *text, int base) { return base == 10 ? ltoa(value, text, base) : ultoa((unsigned)value, text, base); }
extern "C" char *strupr(char *text) {
  for (char *at = text; *at; at++) *at = (char)toupper((unsigned char)*at);
  return text;
}
extern "C" char *strlwr(char *text) {
  for (char *at = text; *at; at++) *at = (char)tolower((unsigned char)*at);
  return text;
}
extern "C" char *utoa(unsigned value, char *text, int base) { return ultoa(value, text, base); }
