#include "simpletools.h"
#include "ping.h"
#include "wavplayer.h"
void show(void) { pause(500); }  // RS322

int main(void)
{
  pause(1000);
  wav_play("a.wav");
  while (1) {
    show();
    if (ping_cm(8) < 10)  // RS322
      pause(20);  // RS322
    while (!input(4));  // RS322
    while (input(4)) { }  // RS322
  }
}
