/* Two tones one after the other. */
#include "simpletools.h"

int main() {
  freqout(4, 300, 1000);
  pause(200);
  freqout(4, 500, 2500);
}
