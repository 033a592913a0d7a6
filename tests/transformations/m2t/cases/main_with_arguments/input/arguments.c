#include "simpletools.h"

int main(int argc, char *argv[])
{
  int i;
  while (1) {
    for (i = 0; i < argc; i++) print("%s\n", argv[i]);
    pause(10);
  }
}
