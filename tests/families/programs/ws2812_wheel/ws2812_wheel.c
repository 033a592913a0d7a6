/* A light that goes round the wheel of colours, dimmed. */
#include "simpletools.h"
#include "ws2812.h"

#define PIN 4

uint32_t color;

int main() {
  ws2812_t strip;
  if (ws2812_start(&strip) < 0)
    return 1;
  for (int pos = 0; pos < 256; pos += 85) {
    color = ws2812_wheel(pos);
    ws2812_set(&strip, PIN, &color, 1);
    pause(20);
    color = ws2812_wheel_dim(pos, 128);
    ws2812_set(&strip, PIN, &color, 1);
    pause(20);
  }
  ws2812_stop(&strip);
}
