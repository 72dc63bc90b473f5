set encoding utf8
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xrange [6666.666666666667:15000000]
set yrange [3.7762507623397058e-16:5.3059258397918903e-12]
set title "Energy error by rounding alone - oscillator, h omega = 0.05" font ",15" noenhanced offset 0,0.3
set xlabel "steps" font ",14" noenhanced
set ylabel "relative energy error, root mean square over starts" font ",14" noenhanced offset -0.5,0
set tics out nomirror
set border 3 linewidth 1.2 linecolor rgb "#404040"
set mxtics 10
set mytics 10
set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb "#e4e4e4"
set key outside right top vertical Left reverse noenhanced samplen 2.2 spacing 1.25 font ",12"
set datafile separator whitespace
set terminal pngcairo size 1300,800 font "DejaVu Sans,12" background rgb "white"
set output "rounding.png"
plot "rounding.dat" index 0 using 1:2 with linespoints linecolor rgb "#001f77b4" linewidth 1.5 pointtype 7 pointsize 1 title "verlet: exponent 0.48", \
     "rounding.dat" index 1 using 1:2 with linespoints linecolor rgb "#006baed6" linewidth 1.5 pointtype 6 pointsize 1 title "verlet-compensated: exponent 0.52", \
     "rounding.dat" index 2 using 1:2 with linespoints linecolor rgb "#00d62728" linewidth 1.5 pointtype 5 pointsize 1 title "blanes-moan-4: exponent 0.45", \
     "rounding.dat" index 3 using 1:2 with linespoints linecolor rgb "#00fb6a4a" linewidth 1.5 pointtype 4 pointsize 1 title "blanes-moan-4-compensated: exponent 0.54", \
     "rounding.dat" index 4 using 1:2 with lines linecolor rgb "#00707070" linewidth 1 dashtype "-" title "square root of the steps"
unset output
set terminal svg size 1300,800 font "DejaVu Sans,12" background rgb "white" enhanced
set output "rounding.svg"
plot "rounding.dat" index 0 using 1:2 with linespoints linecolor rgb "#001f77b4" linewidth 1.5 pointtype 7 pointsize 1 title "verlet: exponent 0.48", \
     "rounding.dat" index 1 using 1:2 with linespoints linecolor rgb "#006baed6" linewidth 1.5 pointtype 6 pointsize 1 title "verlet-compensated: exponent 0.52", \
     "rounding.dat" index 2 using 1:2 with linespoints linecolor rgb "#00d62728" linewidth 1.5 pointtype 5 pointsize 1 title "blanes-moan-4: exponent 0.45", \
     "rounding.dat" index 3 using 1:2 with linespoints linecolor rgb "#00fb6a4a" linewidth 1.5 pointtype 4 pointsize 1 title "blanes-moan-4-compensated: exponent 0.54", \
     "rounding.dat" index 4 using 1:2 with lines linecolor rgb "#00707070" linewidth 1 dashtype "-" title "square root of the steps"
unset output
