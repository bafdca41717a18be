;; One stage of the ventral stream (vmc_lib/what/stream.py), four numbers at a time: 3 x 3 filters, of 2 x 2 neighbours
;; the strongest, and a threshold. Maps lie as (row, column, channel), with a border of zeros; weights as (eight
;; filters, row, column, channel, filter): so a filter's row of a map is one run of numbers, and so are its weights.
(module
  (memory (export "memory") 32)
  (func (export "stage")
    (param $x i32) (param $weights i32) (param $biases i32) (param $out i32)
    (param $size i32) (param $channels i32) (param $filters i32)
    (local $pixel i32) (local $row i32) (local $half i32) (local $i i32) (local $j i32) (local $k i32) (local $tap i32)
    (local $w i32) (local $at i32) (local $end i32) (local $to i32)
    (local $s v128) (local $w0 v128) (local $w1 v128)
    (local $a0 v128) (local $a1 v128) (local $a2 v128) (local $a3 v128)
    (local $b0 v128) (local $b1 v128) (local $b2 v128) (local $b3 v128)
    (local.set $pixel (i32.shl (local.get $channels) (i32.const 2)))
    (local.set $row (i32.mul (i32.add (local.get $size) (i32.const 2)) (local.get $pixel)))
    (local.set $half (i32.shr_u (local.get $size) (i32.const 1)))
    (local.set $to (i32.add (local.get $out) (i32.shl (i32.mul
      (i32.add (local.get $half) (i32.const 3)) (local.get $filters)) (i32.const 2))))
    (loop $rows
      (local.set $j (i32.const 0))
      (loop $columns
        (local.set $w (local.get $weights))
        (local.set $k (i32.const 0))
        (loop $eights
          (local.set $a0 (v128.const i32x4 0 0 0 0))
          (local.set $a1 (local.get $a0)) (local.set $a2 (local.get $a0)) (local.set $a3 (local.get $a0))
          (local.set $b0 (local.get $a0)) (local.set $b1 (local.get $a0))
          (local.set $b2 (local.get $a0)) (local.set $b3 (local.get $a0))
          (local.set $tap (i32.const 0))
          (loop $taps
            (local.set $at (i32.add (local.get $x) (i32.add
              (i32.mul (i32.add (i32.shl (local.get $i) (i32.const 1)) (local.get $tap)) (local.get $row))
              (i32.mul (i32.shl (local.get $j) (i32.const 1)) (local.get $pixel)))))
            (local.set $end (i32.add (local.get $at) (i32.mul (local.get $pixel) (i32.const 3))))
            (loop $run
              (local.set $w0 (v128.load (local.get $w)))
              (local.set $w1 (v128.load offset=16 (local.get $w)))
              (local.set $s (v128.load32_splat (local.get $at)))
              (local.set $a0 (f32x4.add (local.get $a0) (f32x4.mul (local.get $s) (local.get $w0))))
              (local.set $b0 (f32x4.add (local.get $b0) (f32x4.mul (local.get $s) (local.get $w1))))
              (local.set $s (v128.load32_splat (i32.add (local.get $at) (local.get $pixel))))
              (local.set $a1 (f32x4.add (local.get $a1) (f32x4.mul (local.get $s) (local.get $w0))))
              (local.set $b1 (f32x4.add (local.get $b1) (f32x4.mul (local.get $s) (local.get $w1))))
              (local.set $s (v128.load32_splat (i32.add (local.get $at) (local.get $row))))
              (local.set $a2 (f32x4.add (local.get $a2) (f32x4.mul (local.get $s) (local.get $w0))))
              (local.set $b2 (f32x4.add (local.get $b2) (f32x4.mul (local.get $s) (local.get $w1))))
              (local.set $s (v128.load32_splat (i32.add (i32.add (local.get $at) (local.get $row)) (local.get $pixel))))
              (local.set $a3 (f32x4.add (local.get $a3) (f32x4.mul (local.get $s) (local.get $w0))))
              (local.set $b3 (f32x4.add (local.get $b3) (f32x4.mul (local.get $s) (local.get $w1))))
              (local.set $w (i32.add (local.get $w) (i32.const 32)))
              (br_if $run (i32.lt_u (local.tee $at (i32.add (local.get $at) (i32.const 4))) (local.get $end))))
            (br_if $taps (i32.lt_u (local.tee $tap (i32.add (local.get $tap) (i32.const 1))) (i32.const 3))))
          (local.set $at (i32.add (local.get $biases) (local.get $k)))
          (v128.store (local.get $to) (f32x4.max (v128.const i32x4 0 0 0 0) (f32x4.add
            (v128.load (local.get $at))
            (f32x4.max (f32x4.max (local.get $a0) (local.get $a1)) (f32x4.max (local.get $a2) (local.get $a3))))))
          (v128.store offset=16 (local.get $to) (f32x4.max (v128.const i32x4 0 0 0 0) (f32x4.add
            (v128.load offset=16 (local.get $at))
            (f32x4.max (f32x4.max (local.get $b0) (local.get $b1)) (f32x4.max (local.get $b2) (local.get $b3))))))
          (local.set $to (i32.add (local.get $to) (i32.const 32)))
          (br_if $eights (i32.lt_u
            (local.tee $k (i32.add (local.get $k) (i32.const 32))) (i32.shl (local.get $filters) (i32.const 2)))))
        (br_if $columns (i32.lt_u (local.tee $j (i32.add (local.get $j) (i32.const 1))) (local.get $half))))
      (local.set $to (i32.add (local.get $to) (i32.shl (local.get $filters) (i32.const 3)))) ;; over the border
      (br_if $rows (i32.lt_u (local.tee $i (i32.add (local.get $i) (i32.const 1))) (local.get $half))))))
