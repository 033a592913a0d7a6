#include "simpletools.h"
#include "lights.h"

int eye = 3;  // => int eye = 5;
int shown = 4;  // => int shown = 4;
static int hidden = 1;  // => static int hidden = 8;

int main() {
  flash(LEFT_LAMP);  // => flash(LEFT_LAMP);
  flash(27);  // => flash(6);
  print("%d\n", shown);
  high(hidden);  // => high(hidden);
  return look();
}
