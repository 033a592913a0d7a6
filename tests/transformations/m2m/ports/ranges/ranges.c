#include "simpletools.h"

const int low_end = 8;  // => const int low_end = 8;
int sound = 4;  // => int sound = 4;

int main() {
  set_directions(15, low_end, 0xFF);  // => set_directions(15, low_end, 0xFF);
  set_outputs(15, 8, 0b10101010);  // => set_outputs(15, 8, 0b10101010);
  high(low_end);  // => high(port(low_end));
  high(9);  // => high(6);
  square_wave(26, 0, 440);  // => square_wave(3, 0, 440);
  square_wave(-26, 0, 0);  // => square_wave(-26, 0, 0);
  square_wave(-sound, 1, 0);  // => square_wave(-sound, 1, 0);
  freqout(sound, 100, 1000);  // => freqout(port(sound), 100, 1000);
  OUTA |= 1 << 5;  // => OUTA |= 1 << 5;
  while (INA & 0b11);  // => while (INA & 0b11);
}
