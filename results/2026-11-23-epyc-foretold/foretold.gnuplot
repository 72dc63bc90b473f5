set encoding utf8
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xrange [0.0001:1]
set yrange [0.0001:100]
set title 'recommend, foretold and met - 65 pairs of a long motion and an error, seed 616779' font ",15" noenhanced offset 0,0.3
set xlabel 'part of the motion that its pilots saw' font ",14" noenhanced
set ylabel 'actual error over the error asked for (below the line: met)' font ",14" noenhanced offset -0.5,0
set tics out nomirror
set border 3 linewidth 1.2 linecolor rgb "#404040"
set mxtics 10
set mytics 10
set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb "#e4e4e4"
set key outside right top vertical Left reverse noenhanced samplen 2.2 spacing 1.25 font ",12"
set datafile separator whitespace
set terminal pngcairo size 1400,900 font "DejaVu Sans,12" background rgb "white"
set output './foretold.png'
plot './foretold.dat' index 0 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './foretold.dat' index 1 using 1:2 with points linecolor rgb "#00d62728" pointtype 7 pointsize 1.3 title 'blanes-moan-4', \
     './foretold.dat' index 2 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 1.3 title 'dormand-prince-54', \
     './foretold.dat' index 3 using 1:2 with points linecolor rgb "#002ca02c" pointtype 7 pointsize 1.3 title 'rk4'
unset output
set terminal svg size 1400,900 font "DejaVu Sans,12" background rgb "white" enhanced
set output './foretold.svg'
plot './foretold.dat' index 0 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './foretold.dat' index 1 using 1:2 with points linecolor rgb "#00d62728" pointtype 7 pointsize 1.3 title 'blanes-moan-4', \
     './foretold.dat' index 2 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 1.3 title 'dormand-prince-54', \
     './foretold.dat' index 3 using 1:2 with points linecolor rgb "#002ca02c" pointtype 7 pointsize 1.3 title 'rk4'
unset output
