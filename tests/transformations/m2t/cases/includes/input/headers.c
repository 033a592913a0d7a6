#include <stdio.h>    // sprintf
#include <math.h> /* sqrt
   and more */
#include <unistd.h>   // usleep
#include "simpletools.h"
#include "servo.h" /* for
   the arm */
#include <no_such_thing.h>
#ifdef WITH_STRINGS
#include <string.h>
#endif

int main()
{
  servo_speed(16, (int)sqrt(400.0));
  while (1) {
    usleep(100);
    pause(1);
  }
}
