/* Three coloured lights: fixed colours, then one that runs along. */
#include "simpletools.h"
#include "ws2812.h"

uint32_t colors[3] = {COLOR_RED, COLOR_GREEN, 0x010203};

int main() {
  ws2812 *lights = ws2812b_open();
  ws2812_set(lights, 9, colors, 3);
  pause(50);
  for (int n = 0; n < 3; n++) {
    for (int at = 0; at < 3; at++)
      colors[at] = at == n ? COLOR_BLUE : COLOR_BLACK;
    ws2812_set(lights, 9, colors, 3);
    pause(50);
  }
  ws2812_close(lights);
}
