/* Three lights that change their colours. */
#include "simpletools.h"
#include "ws2812.h"

uint32_t colors[3] = {COLOR_RED, 0x010203, COLOR_BLACK};

int main() {
  ws2812_t *lights = ws2812b_open();
  while (1) {
    ws2812_set(lights, 13, colors, 3);
    pause(400);
    uint32_t last = colors[2];
    colors[2] = colors[1];
    colors[1] = colors[0];
    colors[0] = last;
  }
}
