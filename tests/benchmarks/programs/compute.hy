;;;; compute.hy -- what the compute rows measure, in Hy; compute.py and compute.esl say the same

(defn fib [n]
  (if (< n 2)
      n
      (+ (fib (- n 1)) (fib (- n 2)))))

(defn tak [x y z]
  (if (not (< y x))
      z
      (tak (tak (- x 1) y z)
           (tak (- y 1) z x)
           (tak (- z 1) x y))))

(defn is-safe [row placed]
  (setv distance 1)
  (for [other placed]
    (when (or (= other row) (= (abs (- other row)) distance))
      (return False))
    (+= distance 1))
  True)

(defn queens [size placed left]
  (if (= left 0)
      1
      (do
        (setv count 0)
        (for [row (range size)]
          (when (is-safe row placed)
            (+= count (queens size [row #* placed] (- left 1)))))
        count)))

(defn string-work [text rounds]
  (setv found 0)
  (for [_ (range rounds)]
    (setv letters [])
    (for [c text]
      (.append letters
               (if (.isalpha c)
                   (chr (+ 97 (% (+ 3 (- (ord (.lower c)) 97)) 26)))
                   c)))
    (setv shifted (.join "" letters))
    (+= found (.count shifted "e"))
    (when (= (cut (cut shifted None None -1) None None -1) shifted) (+= found 1))
    (when (in "gdb" (+ shifted "-gdb")) (+= found 1))
    (+= found (len (.upper shifted))))
  found)

(defn list-work [size rounds]
  (setv total 0)
  (for [_ (range rounds)]
    (setv numbers (lfor i (range size) (% (* i 7919) 1009)))
    (setv squares (lfor x numbers (* x x)))
    (setv odd (lfor x squares :if (% x 2) x))
    (setv pairs (list (zip numbers squares)))
    (+= total (sum odd))
    (+= total (len (+ odd (cut numbers None None -1))))
    (+= total (get (sorted numbers) 0))
    (for [[number square] pairs]
      (+= total (- square (* number number)))))
  total)
