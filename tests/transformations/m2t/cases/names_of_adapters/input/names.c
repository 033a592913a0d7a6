#include "simpletools.h"
#include "ping.h"
#include "servo.h"

int port = 3;               // port of the adapters
enum { COG_STACK, Servo };
void pause(int ms) { print("%d", ms); }
int Io(int TextOut) { return TextOut + port; }

int main()
{
  int console = 2, cogs_running = 1;
  while (1) {
    console = ping_cm(8) + Io(3) + cogs_running + Servo;
    servo_angle(12, console);
    freqout(4, 100, 1000);
    pause(port);
  }
}
