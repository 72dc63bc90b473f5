set encoding utf8
set datafile separator whitespace
set tics out nomirror font ",11"
set border 3 linewidth 1.2 linecolor rgb "#404040"
set xlabel font ",12"
set ylabel font ",12"
set palette defined (0 "#2166ac", 0.25 "#92c5de", 0.5 "#f7f7f7", 0.75 "#f4a582", 1 "#b2182b")
set cbrange [-0.40000000000000002:0.40000000000000002]
set cblabel "ln of the growth per step (blue decays, red grows)" noenhanced font ",12"
set colorbox user origin 0.945,0.2 size 0.012,0.6
set terminal pngcairo size 2200,1100 font "DejaVu Sans,12" background rgb "white"
set output "maps.png"
set multiplot layout 2,4 rowsfirst margins 0.055,0.925,0.075,0.9 spacing 0.055,0.13 title "Growth of an oscillation per step, measured; line: stability limit in theory; circles: by runs" noenhanced font ",17"
set title "explicit-euler" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 0 using 1:2:3 with image notitle, \
     "maps.dat" index 1 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 2 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "symplectic-euler" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 3 using 1:2:3 with image notitle, \
     "maps.dat" index 4 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 5 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "verlet" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 6 using 1:2:3 with image notitle, \
     "maps.dat" index 7 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 8 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "verlet-compensated" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 9 using 1:2:3 with image notitle, \
     "maps.dat" index 10 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 11 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "blanes-moan-4" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.025000000000000001:8]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 12 using 1:2:3 with image notitle, \
     "maps.dat" index 13 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 14 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "blanes-moan-4-compensated" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.025000000000000001:8]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 15 using 1:2:3 with image notitle, \
     "maps.dat" index 16 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 17 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "rk4" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 18 using 1:2:3 with image notitle, \
     "maps.dat" index 19 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 20 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "dormand-prince-54" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 21 using 1:2:3 with image notitle, \
     "maps.dat" index 22 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 23 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
unset multiplot
unset output
set terminal svg size 2200,1100 font "DejaVu Sans,12" background rgb "white" enhanced
set output "maps.svg"
set multiplot layout 2,4 rowsfirst margins 0.055,0.925,0.075,0.9 spacing 0.055,0.13 title "Growth of an oscillation per step, measured; line: stability limit in theory; circles: by runs" noenhanced font ",17"
set title "explicit-euler" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 0 using 1:2:3 with image notitle, \
     "maps.dat" index 1 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 2 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "symplectic-euler" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 3 using 1:2:3 with image notitle, \
     "maps.dat" index 4 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 5 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "verlet" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 6 using 1:2:3 with image notitle, \
     "maps.dat" index 7 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 8 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "verlet-compensated" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 9 using 1:2:3 with image notitle, \
     "maps.dat" index 10 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 11 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "blanes-moan-4" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.025000000000000001:8]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 12 using 1:2:3 with image notitle, \
     "maps.dat" index 13 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 14 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "blanes-moan-4-compensated" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.025000000000000001:8]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 15 using 1:2:3 with image notitle, \
     "maps.dat" index 16 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 17 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "rk4" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 18 using 1:2:3 with image notitle, \
     "maps.dat" index 19 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 20 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
set title "dormand-prince-54" noenhanced font ",13" offset 0,-0.5
unset logscale x
set format x "%g"
set xrange [0.012500000000000001:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [-3.1034482758620694:1]
set ylabel "damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
set ytics ("0" -3.0689655172413794, "0.01" -2, "0.1" -1, "1" 0, "10" 1)
unset key
plot "maps.dat" index 21 using 1:2:3 with image notitle, \
     "maps.dat" index 22 using 1:2 with points linecolor rgb "#00000000" pointtype 7 pointsize 0.18 notitle, \
     "maps.dat" index 23 using 1:2 with points linecolor rgb "#00000000" pointtype 6 pointsize 1.1 notitle
unset multiplot
unset output
