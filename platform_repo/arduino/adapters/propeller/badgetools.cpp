//# header badgetools.h
//# unsupported the badge has a display of 128 by 64 points, an accelerometer, LEDs, touch buttons and infrared on a board of its own; no adapter replaces them

// ---------------------------------------------------------------- values of the header

//# constant ON
//#   fidelity: exact
#define ON 1L

//# constant OFF
//#   fidelity: exact
#define OFF 0L

//# constant L
//#   fidelity: exact
#define L 1L

//# constant R
//#   fidelity: exact
#define R 0L

//# constant BLUE
//#   fidelity: exact
#define BLUE 1L

//# constant GREEN
//#   fidelity: exact
#define GREEN 2L

//# constant CYAN
//#   fidelity: exact
#define CYAN 3L

//# constant RED
//#   fidelity: exact
#define RED 4L

//# constant MAGENTA
//#   fidelity: exact
#define MAGENTA 5L

//# constant YELLOW
//#   fidelity: exact
#define YELLOW 6L

//# constant WHITE
//#   fidelity: exact
#define WHITE 7L

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

//# constant BLUE_0
//#   fidelity: exact
#define BLUE_0 0L

//# constant BLUE_1
//#   fidelity: exact
#define BLUE_1 1L

//# constant BLUE_2
//#   fidelity: exact
#define BLUE_2 2L

//# constant BLUE_3
//#   fidelity: exact
#define BLUE_3 3L

//# constant BLUE_4
//#   fidelity: exact
#define BLUE_4 4L

//# constant BLUE_5
//#   fidelity: exact
#define BLUE_5 5L

//# constant RGB_B1
//#   fidelity: exact
#define RGB_B1 0L

//# constant RGB_G1
//#   fidelity: exact
#define RGB_G1 1L

//# constant RGB_R1
//#   fidelity: exact
#define RGB_R1 2L

//# constant RGB_B2
//#   fidelity: exact
#define RGB_B2 3L

//# constant RGB_G2
//#   fidelity: exact
#define RGB_G2 4L

//# constant RGB_R2
//#   fidelity: exact
#define RGB_R2 5L

//# constant BTN_0
//#   fidelity: exact
#define BTN_0 27L

//# constant BTN_1
//#   fidelity: exact
#define BTN_1 26L

//# constant BTN_2
//#   fidelity: exact
#define BTN_2 25L

//# constant BTN_5
//#   fidelity: exact
#define BTN_5 17L

//# constant BTN_4
//#   fidelity: exact
#define BTN_4 16L

//# constant BTN_3
//#   fidelity: exact
#define BTN_3 15L

//# constant BTN_OS
//#   fidelity: exact
#define BTN_OS 5L

//# constant IR_BAUD
//#   fidelity: exact
#define IR_BAUD 2400L

//# constant IR_FREQ
//#   fidelity: exact
#define IR_FREQ 36000L

//# constant IR_OUT
//#   fidelity: exact
#define IR_OUT 24L

//# constant IR_IN
//#   fidelity: exact
#define IR_IN 23L

//# constant OLED_DAT
//#   fidelity: exact
#define OLED_DAT 22L

//# constant OLED_CLK
//#   fidelity: exact
#define OLED_CLK 21L

//# constant OLED_DC
//#   fidelity: exact
#define OLED_DC 20L

//# constant OLED_RST
//#   fidelity: exact
#define OLED_RST 19L

//# constant OLED_CS
//#   fidelity: exact
#define OLED_CS 18L

//# constant TV_DAC2
//#   fidelity: exact
#define TV_DAC2 14L

//# constant TV_DAC1
//#   fidelity: exact
#define TV_DAC1 13L

//# constant TV_DAC0
//#   fidelity: exact
#define TV_DAC0 12L

//# constant AUD_RT
//#   fidelity: exact
#define AUD_RT 10L

//# constant AUD_LF
//#   fidelity: exact
#define AUD_LF 9L

//# constant PB0_MASK
//#   fidelity: exact
#define PB0_MASK 1L

//# constant PB1_MASK
//#   fidelity: exact
#define PB1_MASK 2L

//# constant PB2_MASK
//#   fidelity: exact
#define PB2_MASK 4L

//# constant PB3_MASK
//#   fidelity: exact
#define PB3_MASK 8L

//# constant PB4_MASK
//#   fidelity: exact
#define PB4_MASK 16L

//# constant PB5_MASK
//#   fidelity: exact
#define PB5_MASK 32L

//# constant PB6_MASK
//#   fidelity: exact
#define PB6_MASK 64L

//# constant STX
//#   fidelity: exact
#define STX 2L

//# constant ETX
//#   fidelity: exact
#define ETX 3L

//# constant EE_BADGE_DATA_START
//#   fidelity: exact
#define EE_BADGE_DATA_START 32768L

//# constant ACC_INT
//#   fidelity: exact
#define ACC_INT 4L

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
