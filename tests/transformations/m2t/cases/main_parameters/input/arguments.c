#include "simpletools.h"

int main(int argc, char **argv)
{
  if (argc > 1) pause(argc);
  high(2);
  return 0;
}
