//# header badgewxtools.h
//# unsupported the badge WX has a colour display, an accelerometer, LEDs, touch buttons and infrared on a board of its own; no adapter replaces them

// ---------------------------------------------------------------- values of the header

//# constant ON
//#   fidelity: exact
#define ON 1L

//# constant OFF
//#   fidelity: exact
#define OFF 0L

//# constant SCR_BLACK
//#   fidelity: exact
#define SCR_BLACK 0L

//# constant SCR_WHITE
//#   fidelity: exact
#define SCR_WHITE 1L

//# constant SCR_XOR
//#   fidelity: exact
#define SCR_XOR 3L

//# constant LARGE
//#   fidelity: exact
#define LARGE 1L

//# constant SMALL
//#   fidelity: exact
#define SMALL 0L

//# constant AY
//#   fidelity: exact
#define AY 0L

//# constant AX
//#   fidelity: exact
#define AX 1L

//# constant AZ
//#   fidelity: exact
#define AZ 2L

//# constant RGB_PIN
//#   fidelity: exact
#define RGB_PIN 10L

//# constant LED_PIN
//#   fidelity: exact
#define LED_PIN 9L

//# constant NAV_L
//#   fidelity: exact
#define NAV_L 13L

//# constant NAV_C
//#   fidelity: exact
#define NAV_C 12L

//# constant NAV_R
//#   fidelity: exact
#define NAV_R 11L

//# constant NAV_COM_L
//#   fidelity: exact
#define NAV_COM_L 14L

//# constant NAV_COM_R
//#   fidelity: exact
#define NAV_COM_R 15L

//# constant NAV_TOUCH_L
//#   fidelity: exact
#define NAV_TOUCH_L 4L

//# constant NAV_TOUCH_R
//#   fidelity: exact
#define NAV_TOUCH_R 2L

//# constant IR_BAUD
//#   fidelity: exact
#define IR_BAUD 2400L

//# constant IR_FREQ
//#   fidelity: exact
#define IR_FREQ 36000L

//# constant IR_OUT
//#   fidelity: exact
#define IR_OUT 3L

//# constant IR_IN
//#   fidelity: exact
#define IR_IN 23L

//# constant OLED_DAT
//#   fidelity: exact
#define OLED_DAT 21L

//# constant OLED_CLK
//#   fidelity: exact
#define OLED_CLK 20L

//# constant OLED_DC
//#   fidelity: exact
#define OLED_DC 22L

//# constant OLED_RST
//#   fidelity: exact
#define OLED_RST 19L

//# constant OLED_CS
//#   fidelity: exact
#define OLED_CS 18L

//# constant TV_DAC2
//#   fidelity: exact
#define TV_DAC2 26L

//# constant TV_DAC1
//#   fidelity: exact
#define TV_DAC1 25L

//# constant TV_DAC0
//#   fidelity: exact
#define TV_DAC0 24L

//# constant AUD_RT
//#   fidelity: exact
#define AUD_RT 1L

//# constant AUD_LF
//#   fidelity: exact
#define AUD_LF 0L

//# constant STX
//#   fidelity: exact
#define STX 2L

//# constant ETX
//#   fidelity: exact
#define ETX 3L

//# constant EE_BADGE_DATA_START
//#   fidelity: exact
#define EE_BADGE_DATA_START 32768L

//# constant XOUT
//#   fidelity: exact
#define XOUT 0L

//# constant YOUT
//#   fidelity: exact
#define YOUT 1L

//# constant ZOUT
//#   fidelity: exact
#define ZOUT 2L

//# constant TILT
//#   fidelity: exact
#define TILT 3L

//# constant SRST
//#   fidelity: exact
#define SRST 4L

//# constant SPCNT
//#   fidelity: exact
#define SPCNT 5L

//# constant INTSU
//#   fidelity: exact
#define INTSU 6L

//# constant MODE
//#   fidelity: exact
#define MODE 7L

//# constant SR
//#   fidelity: exact
#define SR 8L

//# constant PDET
//#   fidelity: exact
#define PDET 9L

//# constant PD
//#   fidelity: exact
#define PD 10L

//# constant MMA7660_I2C
//#   fidelity: exact
#define MMA7660_I2C 0b1001100L

//# constant ALERT_BIT
//#   fidelity: exact
#define ALERT_BIT 0b01000000L

//# constant ALERT_XYZT
//#   fidelity: exact
#define ALERT_XYZT 0x40404040L

//# constant BUF_SIZE
//#   fidelity: exact
#define BUF_SIZE 128L

//# constant SSD1306_LCDWIDTH
//#   fidelity: exact
#define SSD1306_LCDWIDTH 128L

//# constant SSD1306_LCDHEIGHT32
//#   fidelity: exact
#define SSD1306_LCDHEIGHT32 32L

//# constant SSD1306_LCDHEIGHT64
//#   fidelity: exact
#define SSD1306_LCDHEIGHT64 64L

//# constant SSD1306_LCDCHARMAX
//#   fidelity: exact
#define SSD1306_LCDCHARMAX 8L

//# constant SSD1306_SETCONTRAST
//#   fidelity: exact
#define SSD1306_SETCONTRAST 129L

//# constant SSD1306_DISPLAYALLON_RESUME
//#   fidelity: exact
#define SSD1306_DISPLAYALLON_RESUME 164L

//# constant SSD1306_DISPLAYALLON
//#   fidelity: exact
#define SSD1306_DISPLAYALLON 165L

//# constant SSD1306_NORMALDISPLAY
//#   fidelity: exact
#define SSD1306_NORMALDISPLAY 166L

//# constant SSD1306_INVERTDISPLAY
//#   fidelity: exact
#define SSD1306_INVERTDISPLAY 167L

//# constant SSD1306_DISPLAYOFF
//#   fidelity: exact
#define SSD1306_DISPLAYOFF 174L

//# constant SSD1306_DISPLAYON
//#   fidelity: exact
#define SSD1306_DISPLAYON 175L

//# constant SSD1306_SETDISPLAYOFFSET
//#   fidelity: exact
#define SSD1306_SETDISPLAYOFFSET 211L

//# constant SSD1306_SETCOMPINS
//#   fidelity: exact
#define SSD1306_SETCOMPINS 218L

//# constant SSD1306_SETVCOMDETECT
//#   fidelity: exact
#define SSD1306_SETVCOMDETECT 219L

//# constant SSD1306_SETDISPLAYCLOCKDIV
//#   fidelity: exact
#define SSD1306_SETDISPLAYCLOCKDIV 213L

//# constant SSD1306_SETPRECHARGE
//#   fidelity: exact
#define SSD1306_SETPRECHARGE 217L

//# constant SSD1306_SETMULTIPLEX
//#   fidelity: exact
#define SSD1306_SETMULTIPLEX 168L

//# constant SSD1306_SETLOWCOLUMN
//#   fidelity: exact
#define SSD1306_SETLOWCOLUMN 0L

//# constant SSD1306_SETHIGHCOLUMN
//#   fidelity: exact
#define SSD1306_SETHIGHCOLUMN 16L

//# constant SSD1306_SETSTARTLINE
//#   fidelity: exact
#define SSD1306_SETSTARTLINE 64L

//# constant SSD1306_MEMORYMODE
//#   fidelity: exact
#define SSD1306_MEMORYMODE 32L

//# constant SSD1306_COMSCANINC
//#   fidelity: exact
#define SSD1306_COMSCANINC 192L

//# constant SSD1306_COMSCANDEC
//#   fidelity: exact
#define SSD1306_COMSCANDEC 200L

//# constant SSD1306_SEGREMAP
//#   fidelity: exact
#define SSD1306_SEGREMAP 160L

//# constant SSD1306_CHARGEPUMP
//#   fidelity: exact
#define SSD1306_CHARGEPUMP 141L

//# constant SSD1306_EXTERNALVCC
//#   fidelity: exact
#define SSD1306_EXTERNALVCC 1L

//# constant SSD1306_ACTIVATE_SCROLL
//#   fidelity: exact
#define SSD1306_ACTIVATE_SCROLL 47L

//# constant SSD1306_DEACTIVATE_SCROLL
//#   fidelity: exact
#define SSD1306_DEACTIVATE_SCROLL 46L

//# constant SSD1306_SET_VERT_SCROLL_AREA
//#   fidelity: exact
#define SSD1306_SET_VERT_SCROLL_AREA 163L

//# constant SSD1306_RIGHT_HORIZ_SCROLL
//#   fidelity: exact
#define SSD1306_RIGHT_HORIZ_SCROLL 38L

//# constant SSD1306_LEFT_HORIZ_SCROLL
//#   fidelity: exact
#define SSD1306_LEFT_HORIZ_SCROLL 39L

//# constant SSD1306_VERTRIGHTHORIZSCROLL
//#   fidelity: exact
#define SSD1306_VERTRIGHTHORIZSCROLL 41L

//# constant SSD1306_VERTLEFTHORIZSCROLL
//#   fidelity: exact
#define SSD1306_VERTLEFTHORIZSCROLL 42L
