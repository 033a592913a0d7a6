#include "simpletools.h"

const int eye = 2;

int main()
{
  high(eye);
}
