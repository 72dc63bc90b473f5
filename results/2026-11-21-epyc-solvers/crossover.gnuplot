set encoding utf8
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xrange [341.33333333333331:7372.8000000000002]
set yrange [3207.5804009860549:64881.137395071266]
set title "Where implicit becomes cheaper than explicit" font ",15" noenhanced offset 0,0.3
set xlabel "vertices" font ",14" noenhanced
set ylabel "T omega_max at the crossover" font ",14" noenhanced offset -0.5,0
set tics out nomirror
set border 3 linewidth 1.2 linecolor rgb "#404040"
set mxtics 10
set mytics 10
set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb "#e4e4e4"
set key outside right top vertical Left reverse noenhanced samplen 2.2 spacing 1.25 font ",12"
set datafile separator whitespace
set terminal pngcairo size 1400,900 font "DejaVu Sans,12" background rgb "white"
set output "crossover.png"
plot "crossover.dat" index 0 using 1:2 with linespoints linecolor rgb "#001f77b4" linewidth 1.4 dashtype "-" pointtype 6 pointsize 1.6 title "predicted by the law", \
     "crossover.dat" index 1 using 1:2 with linespoints linecolor rgb "#00d62728" linewidth 1.4 pointtype 7 pointsize 1.6 title "measured", \
     "crossover.dat" index 1 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle
unset output
set terminal svg size 1400,900 font "DejaVu Sans,12" background rgb "white" enhanced
set output "crossover.svg"
plot "crossover.dat" index 0 using 1:2 with linespoints linecolor rgb "#001f77b4" linewidth 1.4 dashtype "-" pointtype 6 pointsize 1.6 title "predicted by the law", \
     "crossover.dat" index 1 using 1:2 with linespoints linecolor rgb "#00d62728" linewidth 1.4 pointtype 7 pointsize 1.6 title "measured", \
     "crossover.dat" index 1 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle
unset output
