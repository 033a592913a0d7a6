/* ws2812.h of the Simple Libraries: chains of coloured LEDs with WS2812 chips. */
#ifndef ROBOSMI_WS2812_H
#define ROBOSMI_WS2812_H
#include <stdint.h>
#define TYPE_RGB 0
#define TYPE_GRB 1
#define COLOR(r, g, b) (((r) << 16) | ((g) << 8) | (b))
#define SCALE(x, l) ((x) * (l) / 255)
#define COLORX(r, g, b, l) ((SCALE(r, l) << 16) | (SCALE(g, l) << 8) | SCALE(b, l))
#define COLOR_BLACK 0x000000
#define COLOR_RED 0xFF0000
#define COLOR_GREEN 0x00FF00
#define COLOR_BLUE 0x0000FF
#define COLOR_WHITE 0xFFFFFF
#define COLOR_CYAN 0x00FFFF
#define COLOR_MAGENTA 0xFF00FF
#define COLOR_YELLOW 0xFFFF00
#define COLOR_CHARTREUSE 0x7FFF00
#define COLOR_ORANGE 0xFF6000
#define COLOR_AQUAMARINE 0x7FFFD4
#define COLOR_PINK 0xFF5F5F
#define COLOR_TURQUOISE 0x3FE0C0
#define COLOR_REALWHITE 0xC8FFFF
#define COLOR_INDIGO 0x3F007F
#define COLOR_VIOLET 0xBF7FBF
#define COLOR_MAROON 0x320010
#define COLOR_BROWN 0x0E0600
#define COLOR_CRIMSON 0xDC283C
#define COLOR_PURPLE 0x8C00FF
typedef struct { volatile uint32_t command; int cog; } ws2812_t;
typedef ws2812_t ws2812;
ws2812_t *ws2812_open(void);
ws2812_t *ws2812b_open(void);
void ws2812_close(ws2812_t *driver);
int ws2812_start(ws2812_t *driver);
int ws2812b_start(ws2812_t *driver);
int ws_start(ws2812_t *driver, int usreset, int ns0h, int ns0l, int ns1h, int ns1l, int type);
void ws2812_stop(ws2812_t *driver);
void ws2812_set(ws2812_t *driver, int pin, uint32_t *colors, int count);
uint32_t ws2812_wheel(int pos);
uint32_t ws2812_wheel_dim(int pos, int brightness);
#endif
