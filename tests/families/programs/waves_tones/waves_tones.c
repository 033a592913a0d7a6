/* A melody on a piezo speaker, a burst of infrared, and a tone in the background. */
#include "simpletools.h"

int piezo = 4;
int notes[] = {523, 1047, 2093};
int lengths[] = {50, 30, 20};

int main() {
  for (int n = 0; n < 3; n++) {
    freqout(piezo, lengths[n], notes[n]);
    pause(40);
  }
  print("%d", get_direction(piezo));
  freqout(11, 1, 38000);
  int seen = input(10);
  print("%d\n", seen);
  pause(20);
  square_wave(piezo, 0, 700);
  pause(60);
  square_wave(piezo, 0, 350);
  pause(60);
  square_wave(-piezo, 0, 0);
  pause(50);
}
