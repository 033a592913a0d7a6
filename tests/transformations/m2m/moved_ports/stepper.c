// expect D9=2 D8=2 D7=2 D6=2
#include "simpletools.h"
enum { COIL_A, COIL_B, COIL_C, COIL_D };
const int coils[4] = { COIL_A, COIL_B, COIL_C, COIL_D };
const char phases[4][4] = {{1,0,0,0},{0,1,0,0},{0,0,1,0},{0,0,0,1}};
int main() {
  for (int i = 0; i < 4; i++) set_direction(coils[i], 1);
  for (int turn = 0; turn < 8; turn++) { for (int c = 0; c < 4; c++) set_output(coils[c], phases[turn % 4][c]); pause(2); }
  for (int c = 0; c < 4; c++) low(coils[c]);
  while (1);
}
