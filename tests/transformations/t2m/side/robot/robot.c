#include "simpletools.h"
#include "settings.h"
#include "turn.h"
#include "eyes.h"

int main()
{
  while (1) {
    if (look(EYE) > NEAR) turn(90);
    pause(20);
  }
}
